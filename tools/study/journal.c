/* journal.c - what each run gave, a line at once when it has ended: id, ending, wall and core time,
 * memory, simulated time, reason, label, between tabs. A line that is cut short is passed over. */
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "study.h"

struct journal {
    FILE *file;
    int lock;
    int n;
    struct journal_entry *entry;
};

/* A run that was too slow for its time is replaced by a later one with more. */
static void keep(struct journal *j, const struct journal_entry *e)
{
    for (int i = 0; i < j->n; i++)
        if (j->entry[i].id == e->id && j->entry[i].ending == RUN_SLOW) {
            char *const reason = xstrdup(e->reason);
            xfree(j->entry[i].reason);
            j->entry[i] = *e;
            j->entry[i].reason = reason;
            return;
        }
    j->entry = xrealloc(j->entry, (size_t)j->n, (size_t)j->n + 1, sizeof *j->entry);
    j->entry[j->n] = *e;
    j->entry[j->n++].reason = xstrdup(e->reason);
}

static void read_line(struct journal *j, char *line)
{
    char *field[8], *at = line;
    for (int i = 0; i < 8; i++) {
        field[i] = at;
        char *const tab = strchr(at, '\t');
        if (!tab && i < 7)
            return;
        if (tab)
            *tab = '\0';
        at = tab ? tab + 1 : at;
    }
    struct journal_entry e = {
        .id = strtoull(field[0], NULL, 16),
        .cost = {strtod(field[2], NULL), strtod(field[3], NULL), strtod(field[4], NULL)},
        .simulated = strtod(field[5], NULL),
        .reason = field[6]};
    for (int k = RUN_GOOD; k <= RUN_BROKEN; k++)
        if (strcmp(field[1], ending_name[k]) == 0)
            e.ending = (enum ending)k;
    if (e.ending != RUN_NONE)
        keep(j, &e);
}

struct journal *journal_open(const char *directory, bool fresh)
{
    struct journal *const j = xalloc(1, sizeof *j);
    char *const path = xprintf("%s/journal.txt", directory);
    const struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    char *const lock = xprintf("%s/lock", directory);
    j->lock = open(lock, O_RDWR | O_CREAT, 0666);
    if (j->lock < 0)
        die(EXIT_WRITE, "%s: %s", lock, strerror(errno));
    if (fcntl(j->lock, F_SETLK, &whole) != 0)
        die(EXIT_SCENE, "%s: another study is at work there", directory);
    fcntl(j->lock, F_SETFD, FD_CLOEXEC);
    if (!fresh) {
        char *const text = file_text(path), *rest = NULL;
        for (char *l = strtok_r(text, "\n", &rest); l; l = strtok_r(NULL, "\n", &rest))
            read_line(j, l);
        xfree(text);
    }
    j->file = fopen(path, fresh ? "w" : "a");
    if (!j->file)
        die(EXIT_WRITE, "%s: %s", path, strerror(errno));
    fcntl(fileno(j->file), F_SETFD, FD_CLOEXEC);
    if (ftell(j->file) > 0)
        fputc('\n', j->file); /* ends a line that was cut short */
    xfree(path);
    xfree(lock);
    return j;
}

void journal_close(struct journal *j)
{
    fclose(j->file);
    close(j->lock);
    for (int i = 0; i < j->n; i++)
        xfree(j->entry[i].reason);
    xfree(j->entry);
    xfree(j);
}

const struct journal_entry *journal_find(const struct journal *j, uint64_t id, int k)
{
    for (int i = 0; i < j->n; i++)
        if (j->entry[i].id == id && k-- == 0)
            return &j->entry[i];
    return NULL;
}

void journal_add(struct journal *j, const struct journal_entry *e, const char *label)
{
    char *const reason = xstrdup(e->reason);
    for (char *c = reason; *c; c++)
        if (*c == '\t' || *c == '\n')
            *c = ' ';
    fprintf(j->file, "%016" PRIx64 "\t%s\t%.6f\t%.6f\t%.0f\t%.10g\t%s\t%s\n", e->id,
            ending_name[e->ending], e->cost.wall, e->cost.core, e->cost.memory, e->simulated,
            reason, label);
    if (fflush(j->file) != 0)
        die(EXIT_WRITE, "the journal of the study: %s", strerror(errno));
    struct journal_entry clean = *e;
    clean.reason = reason;
    keep(j, &clean);
    xfree(reason);
}
