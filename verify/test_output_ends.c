/* verify/test_output_ends.c - runs that end badly: a crash, a kill, a full disk, a folder that
 * cannot be made. They are children of this program, judged by their exit status and by what
 * they leave. */
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include "made_run.h"

/* Runs `child` in a process of its own; its status as waitpid gives it. */
static int run_child(void (*child)(struct scene *), struct scene *scene)
{
    int status = 0;
    fflush(stdout);
    const pid_t pid = fork();
    if (pid < 0)
        abort();
    if (pid == 0) {
        if (!freopen("/dev/null", "w", stderr))
            _exit(99);
        child(scene);
        _exit(98); /* a child must not come back */
    }
    if (waitpid(pid, &status, 0) != pid)
        abort();
    return status;
}

static void check_exit(int status, int want, const char *text)
{
    check(WIFEXITED(status) && WEXITSTATUS(status) == want, "%s: exit status %d, want %d", text,
          WIFEXITED(status) ? WEXITSTATUS(status) : -1, want);
}

static struct sim *dying;
static void last_words(int code, const char *message)
{
    (void)code;
    output_crash(dying, message);
}

static void crashing(struct scene *scene)
{
    dying = made_sim(true, true, "crash");
    output_create(dying, scene);
    output_fields(dying);
    set_state(dying, 0.451);
    output_sample(dying);
    die_hook = last_words;
    die(EXIT_UNSTABLE, "grain %d is not finite", 4);
}

static void killed(struct scene *scene)
{
    struct sim *const s = made_sim(true, true, "killed");
    output_create(s, scene);
    for (int k = 0; k < 2; k++) {
        set_state(s, 0.237 * 3 * k);
        output_sample(s);
        output_fields(s);
    }
    raise(SIGKILL);
}

static void without_room(struct scene *scene)
{
    const struct rlimit limit = {20000, 20000}; /* bytes per file: as a full disk would */
    signal(SIGXFSZ, SIG_IGN);
    struct sim *const s = made_sim(true, true, "full");
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0)
        _exit(97);
    output_create(s, scene);
    for (int k = 0; k < 1000; k++)
        output_fields(s);
    output_close(s);
}

static void without_folder(struct scene *scene)
{
    output_create(made_sim(true, true, "scene.ini/out"), scene); /* scene.ini is a file */
}

static void read_only(struct scene *scene)
{
    struct sim *const s = made_sim(true, true, "locked");
    if (mkdir(s->run.directory, 0555) != 0)
        _exit(97);
    output_create(s, scene);
}

static void test_bad_ends(struct scene *scene)
{
    double worst = 0.0;
    struct stat info;
    check_exit(run_child(crashing, scene), EXIT_UNSTABLE, "a run that crashes");
    int nc = open_nc("crash", "crash.nc");
    check_text(nc, NULL, "message", "grain 4 is not finite");
    check_rel(number(nc, "time", (const size_t[]){0}), 0.451, 1e-15, "time of the crash");
    check_rel(number(nc, "position", (const size_t[]){0, 4, 2}), grain_value(4, 2, 0.451),
              1e-15, "a grain at the crash");
    check_rel(number(nc, "fluid_fraction", (const size_t[]){0, 4, 3, 2}),
              cell_value(3, 4, 5, 0.451), 1e-15, "a field at the crash");
    nc_close(nc);
    nc = open_nc("crash", "run.nc.part");
    check_rel(number(nc, "position", (const size_t[]){0, 4, 2}), grain_value(4, 2, 0.0), 1e-15,
              "what was written before the crash is readable");
    check_rel(number(nc, "kinetic_energy", (const size_t[]){0}), 5.19 * 0.451, 1e-15,
              "so is the last sample");
    nc_close(nc);

    const int status = run_child(killed, scene);
    check(WIFSIGNALED(status), "a run that is killed");
    nc = open_nc("killed", "run.nc.part");
    for (size_t id = 0; id < GRAINS; id++) {
        const double off = number(nc, "position", (const size_t[]){1, id, 1}) -
                           grain_value((int)id, 1, 0.237 * 3);
        worst = fabs(off) <= worst ? worst : fabs(off);
    }
    check(worst == 0.0, "both outputs before the kill are readable: off by %g", worst);
    nc_close(nc);

    check_exit(run_child(without_room, scene), EXIT_WRITE, "a disk that fills up");
    char *const path = xprintf("%s/full/run.nc", folder);
    check(stat(path, &info) != 0, "a file that could not be completed does not take its name");
    xfree(path);
    check_exit(run_child(without_folder, scene), EXIT_WRITE, "a folder that cannot be made");
    if (geteuid() != 0) /* root may write anywhere */
        check_exit(run_child(read_only, scene), EXIT_WRITE, "a folder without permission");
}

int main(void)
{
    if (!mkdtemp(folder))
        return 2;
    struct scene *const scene = made_scene();
    test_bad_ends(scene);
    scene_free(scene);
    clean_up();
    return check_end();
}
