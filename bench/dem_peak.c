/* bench/dem_peak.c - runs a program and leaves in a file the most memory that it took, in bytes:
 *   dem_peak FILE PROGRAM [ARGUMENT ...]
 * The exit code is the program's. Of several processes (mpirun) it would be the largest alone. */
#define _DEFAULT_SOURCE /* wait4 */
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

int main(int argc, char **argv)
{
    if (argc < 3) {
        fprintf(stderr, "usage: dem_peak FILE PROGRAM [ARGUMENT ...]\n");
        return EXIT_FAILURE;
    }
    const pid_t child = fork();
    if (child == 0) {
        execvp(argv[2], argv + 2);
        perror(argv[2]);
        _exit(127);
    }
    int status = 0;
    struct rusage use;
    if (child < 0 || wait4(child, &status, 0, &use) != child) {
        perror("dem_peak");
        return EXIT_FAILURE;
    }
    FILE *const f = fopen(argv[1], "w");
    if (f == NULL || fprintf(f, "%ld\n", 1024L * use.ru_maxrss) < 0 || fclose(f) != 0) {
        perror(argv[1]);
        return EXIT_FAILURE;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE;
}
