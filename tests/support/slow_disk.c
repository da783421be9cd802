/* slow_disk.so, loaded before a program's libraries: a disk that makes 100 commits a second, for
 * all programs together that it is loaded into. SLOW_DISK names the file by which they
 * take turns. */

#define _GNU_SOURCE
#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static const struct timespec one_commit = {.tv_nsec = 10 * 1000 * 1000};

static void wait_for_disk(void) {
  const char* disk = getenv("SLOW_DISK");
  int turn = disk == NULL ? -1 : open(disk, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (turn >= 0) flock(turn, LOCK_EX);
  // Not nanosleep: the simulated plant replaces it by its own clock.
  syscall(SYS_nanosleep, &one_commit, NULL);
  if (turn >= 0) close(turn);
}

int fsync(int file) {
  wait_for_disk();
  return (int)syscall(SYS_fsync, file);
}

int fdatasync(int file) {
  wait_for_disk();
  return (int)syscall(SYS_fdatasync, file);
}
