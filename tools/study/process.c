/* process.c - one run as a process of its own: its time, its memory, its end. */
#include "process_posix.h"
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>
#include "study.h"

static volatile sig_atomic_t caught;

static void on_signal(int which)
{
    if (which != SIGALRM)
        caught = which;
}

int process_caught(void)
{
    return caught;
}

/* No SA_RESTART: a signal must end the wait below. */
void process_signals(void)
{
    struct sigaction act = {.sa_handler = on_signal};
    sigemptyset(&act.sa_mask);
    sigaction(SIGINT, &act, NULL);
    sigaction(SIGTERM, &act, NULL);
    sigaction(SIGHUP, &act, NULL);
    sigaction(SIGALRM, &act, NULL);
}

static void redirect(const char *path, int fd)
{
    if (!path)
        return;
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file < 0)
        _exit(127);
    dup2(file, fd);
    close(file);
}

/* A group of its own: the terminal's Ctrl-C comes to this program alone, which hands it on. */
static pid_t start(char *const argv[], const char *out, const char *err)
{
    const pid_t child = fork();
    if (child != 0)
        return child;
    setpgid(0, 0);
    const struct sigaction standard = {.sa_handler = SIG_DFL};
    sigaction(SIGINT, &standard, NULL);
    sigaction(SIGTERM, &standard, NULL);
    sigaction(SIGHUP, &standard, NULL);
    sigaction(SIGALRM, &standard, NULL);
    const int null = open("/dev/null", O_RDONLY);
    dup2(null, STDIN_FILENO);
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    execvp(argv[0], argv);
    _exit(127);
}

struct process process_run(char *const argv[], const char *out, const char *err, double timeout,
                           double grace)
{
    struct process p = {0};
    struct process_end end = {0};
    double asked = 0.0;
    const double begin = wall_clock();
    fflush(NULL);
    const pid_t child = start(argv, out, err);
    if (child < 0)
        die(EXIT_WRITE, "no process can be started: %s", strerror(errno));
    process_alarm(true);
    while (!process_wait(child, &end)) {
        const double now = wall_clock() - begin;
        if (asked == 0.0 && (caught || (timeout > 0.0 && now > timeout))) {
            p.late = !caught;
            asked = now;
            kill(-child, SIGTERM);
        } else if (asked > 0.0 && now > asked + grace) {
            p.hung = true;
            kill(-child, SIGKILL);
        }
    }
    process_alarm(false);
    p.cost = (struct cost){wall_clock() - begin, end.core, end.memory};
    p.crashed = end.signal != 0 && !p.hung;
    p.code = end.signal ? 128 + end.signal : end.code;
    return p;
}

enum ending process_judge(const struct process *p, const char *err, const char *folder,
                          char **reason)
{
    char *const said = reason_of(err), *const summary = xprintf("%s/summary.txt", folder);
    enum ending ending = RUN_BROKEN;
    *reason = NULL;
    if (p->hung)
        *reason = xprintf("hangs: did not end when asked to, killed");
    else if (p->crashed && p->late)
        *reason =
            xprintf("ended without its outputs when its time was over: it had not started, "
                    "or hangs");
    else if (p->crashed)
        *reason = xprintf("crash: signal %d %s", p->code - 128, said);
    else if (p->late)
        ending = RUN_SLOW;
    else if (p->code == EXIT_GOOD)
        ending = access(summary, R_OK) == 0 ? RUN_GOOD : RUN_BROKEN;
    else if (p->code == EXIT_SCENE && said[0])
        ending = RUN_REFUSED;
    else if (p->code == EXIT_UNSTABLE && said[0])
        ending = RUN_STOPPED;
    else
        *reason = xprintf("exit code %d %s", p->code, said);
    if (!*reason && ending == RUN_SLOW)
        *reason = xprintf("longer than its %.3g s", p->cost.wall);
    if (!*reason && ending == RUN_BROKEN)
        *reason = xprintf("no summary");
    if (!*reason)
        *reason = xstrdup(ending == RUN_GOOD ? "" : said);
    xfree(said);
    xfree(summary);
    return ending;
}

char *file_text(const char *path)
{
    FILE *const f = fopen(path, "r");
    size_t n = 0, capacity = 4096;
    char *text = xalloc(capacity, 1);
    while (f) {
        const size_t got = fread(text + n, 1, capacity - n - 1, f);
        n += got;
        if (got == 0)
            break;
        if (n + 1 == capacity) {
            text = xrealloc(text, capacity, 2 * capacity, 1);
            capacity *= 2;
        }
    }
    if (f)
        fclose(f);
    text[n] = '\0';
    return text;
}

uint64_t hash_text(uint64_t h, const char *text)
{
    for (const unsigned char *c = (const unsigned char *)text; *c; c++)
        h = (h ^ *c) * 1099511628211ull;
    return (h ^ 0xffu) * 1099511628211ull;
}

uint64_t hash_file(uint64_t h, const char *path)
{
    unsigned char block[65536];
    FILE *const f = fopen(path, "rb");
    size_t n;
    if (!f)
        return hash_text(h, "");
    while ((n = fread(block, 1, sizeof block, f)) > 0)
        for (size_t i = 0; i < n; i++)
            h = (h ^ block[i]) * 1099511628211ull;
    fclose(f);
    return h;
}
