/* Compiles the handle tables one by one and fails where they cost too much; the target handle_budgets runs it
   as

     handle_budgets_runner SIZE SECONDS MEGABYTES KIBIBYTES (TABLE OBJECT COMMAND... --)...

   SIZE is the program `size` of the compiler's binutils, which tells the bytes of an object's sections. The
   limits are on each table's compilation, in seconds of the processor, which do not depend on what else runs, and in
   peak megabytes, and on all read-only data. */
#define _DEFAULT_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

static double seconds_of(struct timeval t) { return (double)t.tv_sec + (double)t.tv_usec / 1e6; }

/* Runs a command; the peak memory of its children in megabytes, or a negative number where it fails, and their
   seconds. The compiler proper is a child of its driver, and wait4 counts what a child has waited for. */
static double run(char** command, double* seconds) {
  struct rusage usage;
  int status = 0;
  const pid_t child = fork();
  if (child == 0) {
    execvp(command[0], command);
    perror(command[0]);
    _exit(127);
  }
  if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) return -1;
  *seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
#ifdef __APPLE__
  return (double)usage.ru_maxrss / (1024.0 * 1024.0);
#else
  return (double)usage.ru_maxrss / 1024.0;
#endif
}

/* The bytes of an object's read-only sections, by `size -A`. */
static long read_only_bytes(const char* size, const char* object) {
  char command[4096], line[512], name[256];
  long sum = 0, bytes = 0;
  FILE* pipe;
  snprintf(command, sizeof command, "'%s' -A '%s'", size, object);
  pipe = popen(command, "r");
  if (pipe == NULL) return -1;
  while (fgets(line, sizeof line, pipe) != NULL)
    if (sscanf(line, "%255s %ld", name, &bytes) == 2 &&
        (strncmp(name, ".rodata", 7) == 0 || strncmp(name, ".data.rel.ro", 12) == 0))
      sum += bytes;
  return pclose(pipe) == 0 ? sum : -1;
}

int main(int count, char** argument) {
  double most_seconds, most_megabytes;
  long most_kilobytes, all_bytes = 0;
  int failed = 0, at = 5;
  if (count < 5) return 2;
  most_seconds = atof(argument[2]), most_megabytes = atof(argument[3]), most_kilobytes = atol(argument[4]);
  printf("%-34s %9s %9s %9s\n", "table", "seconds", "MB", "bytes");
  while (at + 2 < count) {
    const char *source = argument[at], *object = argument[at + 1];
    char** command = argument + at + 2;
    double seconds = 0, megabytes;
    long bytes;
    for (at += 2; at < count && strcmp(argument[at], "--") != 0;) ++at;
    argument[at++] = NULL;
    megabytes = run(command, &seconds);
    bytes = megabytes < 0 ? -1 : read_only_bytes(argument[1], object);
    printf("%-34s %9.1f %9.0f %9ld\n", source, seconds, megabytes, bytes);
    fflush(stdout);
    if (bytes < 0 || seconds > most_seconds || megabytes > most_megabytes) failed = 1;
    all_bytes += bytes > 0 ? bytes : 0;
  }
  printf("%-34s %9s %9s %9ld\n", "all", "", "", all_bytes);
  if (all_bytes > most_kilobytes * 1024) failed = 1;
  if (failed)
    printf("Over the budget of %.0f s and %.0f MB for each, %ld KiB for all.\n", most_seconds, most_megabytes,
           most_kilobytes);
  return failed;
}
