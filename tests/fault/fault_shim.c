/* Makes the file system fail under a program: a library to be preloaded (LD_PRELOAD).
 *
 *   CUPOLA_FAULT_PROGRAM  acts in the program of this name only (of several ranks: in rank 0)
 *   CUPOLA_FAULT_UNDER    acts on files below this folder only
 *   CUPOLA_FAULT_AT       on the n-th operation that changes a file (read-eio: that reads one)
 *   CUPOLA_FAULT_KIND     enospc    that write and all later ones fail: the disk is full
 *                         eio       that operation fails
 *                         read-eio  that read fails
 *                         short     that write takes only a part
 *                         power-cut what is not synced is lost, then the process is killed
 *   CUPOLA_FAULT_ONCE     a file made when it has happened; where it is there, nothing happens
 *   CUPOLA_FAULT_COUNT    a file that gets a line `program changes reads` when the program ends
 *   CUPOLA_FAULT_CLOCK    seconds the clock of the day is put forward (negative: back)
 *
 * A test in the program itself sets the next fault with cupola_fault_arm (found by dlsym), and asks with cupola_fault_reads and
 * cupola_fault_changes how many of them there were since.
 *
 * A power cut loses the bytes written to a file since its last fsync, a file made since, and a rename whose folder was not
 * synced since: the file has its old name and the old file is back (as a journalling file system leaves it).
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

#define REAL(type, name, ...)                            \
  static type (*real_##name)(__VA_ARGS__);               \
  if (!real_##name) *(void**)(&real_##name) = dlsym(RTLD_NEXT, #name)

enum { most_descriptors = 4096, most_files = 4096 };

struct file {
  char path[PATH_MAX];
  off_t synced; /* bytes that a power cut leaves */
  int dirty, fresh;
};
struct pending_rename {
  char from[PATH_MAX], to[PATH_MAX], backup[PATH_MAX];
};

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static int active = -1;
static char under[PATH_MAX], kind[32], program[64];
static long at = -1, changes, reads, clock_shift;
static int happened, power_cut;
static struct file files[most_files];
static int file_count;
static struct pending_rename renames[most_files];
static int rename_count;
static char* descriptor_path[most_descriptors];
static char descriptor_reads[most_descriptors];

static void set_up(void) {
  if (active >= 0) return;
  active = 0;
  const char* shift = getenv("CUPOLA_FAULT_CLOCK");
  if (shift) clock_shift = atol(shift);
  const char* wanted = getenv("CUPOLA_FAULT_PROGRAM");
  const char* rank = getenv("OMPI_COMM_WORLD_RANK");
  const char* folder = getenv("CUPOLA_FAULT_UNDER");
  char own[PATH_MAX];
  const ssize_t length = readlink("/proc/self/exe", own, sizeof own - 1);
  if (!wanted || !folder || length < 0 || (rank && strcmp(rank, "0") != 0)) return;
  own[length] = 0;
  snprintf(program, sizeof program, "%s", strrchr(own, '/') + 1);
  if (strcmp(wanted, "*") != 0 && strcmp(wanted, program) != 0) return;
  snprintf(under, sizeof under, "%s", folder);
  snprintf(kind, sizeof kind, "%s", getenv("CUPOLA_FAULT_KIND") ? getenv("CUPOLA_FAULT_KIND") : "");
  if (getenv("CUPOLA_FAULT_AT")) at = atol(getenv("CUPOLA_FAULT_AT"));
  power_cut = strcmp(kind, "power-cut") == 0;
  active = 1;
}

__attribute__((constructor)) static void begin(void) { set_up(); }

__attribute__((destructor)) static void end(void) {
  const char* file = getenv("CUPOLA_FAULT_COUNT");
  if (active != 1 || !file) return;
  FILE* out = fopen(file, "a");
  if (!out) return;
  fprintf(out, "%s %ld %ld\n", program, changes, reads);
  fclose(out);
}

/* A fault on the n-th operation from now on, in whatever program this is; number 0: none, only counting. */
void cupola_fault_arm(const char* folder, const char* wanted_kind, long number) {
  snprintf(under, sizeof under, "%s", folder);
  snprintf(kind, sizeof kind, "%s", wanted_kind);
  at = number;
  changes = reads = happened = 0;
  active = 1;
}
long cupola_fault_reads(void) { return reads; }
long cupola_fault_changes(void) { return changes; }

static int is_ours(const char* path) { return active == 1 && path && strncmp(path, under, strlen(under)) == 0; }
static const char* path_of(int descriptor) {
  return descriptor >= 0 && descriptor < most_descriptors ? descriptor_path[descriptor] : NULL;
}

/* Whether it is to happen now; at most once on a machine where a marker file is asked for. */
static int due(const char* wanted_kind, long number) {
  if (happened || number != at || strcmp(kind, wanted_kind) != 0) return 0;
  const char* marker = getenv("CUPOLA_FAULT_ONCE");
  if (marker) {
    REAL(int, open, const char*, int, ...);
    REAL(int, close, int);
    const int made = real_open(marker, O_WRONLY | O_CREAT | O_EXCL, 0644);
    if (made < 0) return 0;
    real_close(made);
  }
  happened = 1;
  return 1;
}

static struct file* file_of(const char* path) {
  for (int i = 0; i < file_count; ++i)
    if (strcmp(files[i].path, path) == 0) return &files[i];
  if (file_count == most_files) return NULL;
  struct file* file = &files[file_count++];
  memset(file, 0, sizeof *file);
  snprintf(file->path, sizeof file->path, "%s", path);
  return file;
}

static void cut_power(void) {
  REAL(int, rename, const char*, const char*);
  while (rename_count > 0) {
    struct pending_rename* last = &renames[--rename_count];
    real_rename(last->to, last->from);
    if (last->backup[0]) real_rename(last->backup, last->to);
    struct file* file = file_of(last->to);
    if (file) snprintf(file->path, sizeof file->path, "%s", last->from);
  }
  for (int i = 0; i < file_count; ++i) {
    if (!files[i].dirty) continue;
    if (files[i].fresh)
      unlink(files[i].path);
    else if (truncate(files[i].path, files[i].synced) != 0)
      continue;
  }
  kill(getpid(), SIGKILL);
}

/* One more operation that changes a file. @return the error it ends with, 0 for none */
static int change(const char* path) {
  if (!is_ours(path)) return 0;
  pthread_mutex_lock(&mutex);
  ++changes;
  if (due("power-cut", changes)) cut_power();
  const int full = due("enospc", changes) || (happened && strcmp(kind, "enospc") == 0);
  const int error = due("eio", changes) ? EIO : full ? ENOSPC : 0;
  pthread_mutex_unlock(&mutex);
  return error;
}

static int read_error(int descriptor) {
  if (active != 1 || !path_of(descriptor) || !descriptor_reads[descriptor]) return 0;
  pthread_mutex_lock(&mutex);
  ++reads;
  const int error = due("read-eio", reads) ? EIO : 0;
  pthread_mutex_unlock(&mutex);
  return error;
}

static int opened(int descriptor, const char* path, int flags, int existed) {
  if (descriptor < 0 || descriptor >= most_descriptors || !is_ours(path)) return descriptor;
  pthread_mutex_lock(&mutex);
  free(descriptor_path[descriptor]);
  descriptor_path[descriptor] = strdup(path);
  descriptor_reads[descriptor] = (flags & O_ACCMODE) == O_RDONLY && !(flags & O_DIRECTORY);
  if (power_cut && (flags & O_ACCMODE) != O_RDONLY) {
    struct stat state;
    struct file* file = file_of(path);
    if (file && !file->dirty) file->synced = fstat(descriptor, &state) == 0 ? state.st_size : 0;
    if (file && (!existed || (flags & O_TRUNC))) {
      file->dirty = 1;
      file->synced = 0;
      file->fresh = !existed;
    }
  }
  pthread_mutex_unlock(&mutex);
  return descriptor;
}

static void forget(int descriptor) {
  if (!path_of(descriptor)) return;
  pthread_mutex_lock(&mutex);
  free(descriptor_path[descriptor]);
  descriptor_path[descriptor] = NULL;
  pthread_mutex_unlock(&mutex);
}

/* open(2) of whatever name: a new or emptied file is a change. */
#define OPEN(name)                                                                \
  int name(const char* path, int flags, ...) {                                    \
    REAL(int, name, const char*, int, ...);                                       \
    va_list arguments;                                                            \
    va_start(arguments, flags);                                                   \
    const int mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(arguments, int) : 0;  \
    va_end(arguments);                                                            \
    set_up();                                                                     \
    const int ours = is_ours(path);                                               \
    const int existed = ours && access(path, F_OK) == 0;                          \
    if (ours && (flags & O_ACCMODE) != O_RDONLY && ((flags & O_TRUNC) || !existed)) { \
      const int error = change(path);                                             \
      if (error) return errno = error, -1;                                        \
    }                                                                             \
    return opened(real_##name(path, flags, mode), path, flags, existed);          \
  }
OPEN(open)
OPEN(open64)

/* Streams: libstdc++'s read and write their descriptor themselves, so that those of C++ are seen; those of C are not. */
#define FOPEN(name)                                                                                  \
  FILE* name(const char* path, const char* mode) {                                                   \
    REAL(FILE*, name, const char*, const char*);                                                     \
    set_up();                                                                                        \
    const int ours = is_ours(path);                                                                  \
    const int existed = ours && access(path, F_OK) == 0;                                             \
    const int flags = mode[0] == 'r' && !strchr(mode, '+') ? O_RDONLY                                \
                                                           : O_WRONLY | (mode[0] == 'w' ? O_TRUNC : 0); \
    if (ours && flags != O_RDONLY && ((flags & O_TRUNC) || !existed)) {                              \
      const int error = change(path);                                                                \
      if (error) return errno = error, NULL;                                                         \
    }                                                                                                \
    FILE* stream = real_##name(path, mode);                                                          \
    if (stream) opened(fileno(stream), path, flags, existed);                                        \
    return stream;                                                                                   \
  }
FOPEN(fopen)
FOPEN(fopen64)

int fclose(FILE* stream) {
  REAL(int, fclose, FILE*);
  forget(fileno(stream));
  return real_fclose(stream);
}

int close(int descriptor) {
  REAL(int, close, int);
  forget(descriptor);
  return real_close(descriptor);
}

/* Before a write: the error, or how many bytes it may take. */
static int before_write(int descriptor, size_t* count) {
  const char* path = path_of(descriptor);
  if (!is_ours(path)) return 0;
  const int error = change(path);
  pthread_mutex_lock(&mutex);
  if (power_cut) {
    struct file* file = file_of(path);
    if (file) file->dirty = 1;
  }
  if (!error && *count > 1 && due("short", changes)) *count /= 2;
  pthread_mutex_unlock(&mutex);
  return error;
}

ssize_t write(int descriptor, const void* bytes, size_t count) {
  REAL(ssize_t, write, int, const void*, size_t);
  const int error = before_write(descriptor, &count);
  if (error) return errno = error, -1;
  return real_write(descriptor, bytes, count);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t count, off_t offset) {
  REAL(ssize_t, pwrite, int, const void*, size_t, off_t);
  const int error = before_write(descriptor, &count);
  if (error) return errno = error, -1;
  return real_pwrite(descriptor, bytes, count, offset);
}

ssize_t writev(int descriptor, const struct iovec* parts, int count) {
  REAL(ssize_t, writev, int, const struct iovec*, int);
  size_t whole = 2; /* a short write takes one part of several */
  const int error = before_write(descriptor, &whole);
  if (error) return errno = error, -1;
  return real_writev(descriptor, parts, whole == 1 && count > 1 ? 1 : count);
}

/* std::filesystem::copy_file */
#define SENDFILE(name, offset_type)                                            \
  ssize_t name(int to, int from, offset_type* offset, size_t count) {          \
    REAL(ssize_t, name, int, int, offset_type*, size_t);                       \
    int error = read_error(from);                                              \
    if (!error) error = before_write(to, &count);                              \
    if (error) return errno = error, -1;                                       \
    return real_##name(to, from, offset, count);                               \
  }
SENDFILE(sendfile, off_t)
SENDFILE(sendfile64, off64_t)

ssize_t pwrite64(int descriptor, const void* bytes, size_t count, off64_t offset) {
  return pwrite(descriptor, bytes, count, offset);
}

ssize_t read(int descriptor, void* bytes, size_t count) {
  REAL(ssize_t, read, int, void*, size_t);
  const int error = read_error(descriptor);
  if (error) return errno = error, -1;
  return real_read(descriptor, bytes, count);
}

ssize_t pread(int descriptor, void* bytes, size_t count, off_t offset) {
  REAL(ssize_t, pread, int, void*, size_t, off_t);
  const int error = read_error(descriptor);
  if (error) return errno = error, -1;
  return real_pread(descriptor, bytes, count, offset);
}

ssize_t pread64(int descriptor, void* bytes, size_t count, off64_t offset) {
  return pread(descriptor, bytes, count, offset);
}

int fsync(int descriptor) {
  REAL(int, fsync, int);
  const char* path = path_of(descriptor);
  const int error = change(path);
  if (error) return errno = error, -1;
  const int result = real_fsync(descriptor);
  struct stat state;
  if (result == 0 && power_cut && is_ours(path) && fstat(descriptor, &state) == 0) {
    pthread_mutex_lock(&mutex);
    if (S_ISDIR(state.st_mode)) {
      int kept = 0;
      for (int i = 0; i < rename_count; ++i) {
        const size_t length = strlen(path);
        const int here = strncmp(renames[i].to, path, length) == 0 && renames[i].to[length] == '/' &&
                         strchr(renames[i].to + length + 1, '/') == NULL;
        if (here && renames[i].backup[0]) unlink(renames[i].backup);
        if (!here) renames[kept++] = renames[i];
      }
      rename_count = kept;
    } else {
      struct file* file = file_of(path);
      if (file) {
        file->synced = state.st_size;
        file->dirty = file->fresh = 0;
      }
    }
    pthread_mutex_unlock(&mutex);
  }
  return result;
}

int rename(const char* from, const char* to) {
  REAL(int, rename, const char*, const char*);
  const int error = change(to);
  if (error) return errno = error, -1;
  if (power_cut && is_ours(to) && rename_count < most_files) {
    pthread_mutex_lock(&mutex);
    struct pending_rename* entry = &renames[rename_count];
    memset(entry, 0, sizeof *entry);
    snprintf(entry->from, sizeof entry->from, "%s", from);
    snprintf(entry->to, sizeof entry->to, "%s", to);
    static int backups;
    snprintf(entry->backup, sizeof entry->backup, "%.3900s.%d.part", to, backups++);
    if (link(to, entry->backup) != 0) entry->backup[0] = 0;
    ++rename_count;
    for (int i = 0; i < file_count; ++i) /* what stood there is gone */
      if (strcmp(files[i].path, to) == 0) files[i].dirty = 0, files[i].path[0] = 0;
    for (int i = 0; i < file_count; ++i)
      if (strcmp(files[i].path, from) == 0) snprintf(files[i].path, sizeof files[i].path, "%s", to);
    pthread_mutex_unlock(&mutex);
  }
  return real_rename(from, to);
}

int clock_gettime(clockid_t clock, struct timespec* now) {
  REAL(int, clock_gettime, clockid_t, struct timespec*);
  const int result = real_clock_gettime(clock, now);
  if (result == 0 && clock == CLOCK_REALTIME) now->tv_sec += clock_shift;
  return result;
}

time_t time(time_t* now) {
  struct timespec moment;
  clock_gettime(CLOCK_REALTIME, &moment);
  if (now) *now = moment.tv_sec;
  return moment.tv_sec;
}

int gettimeofday(struct timeval* restrict now, void* restrict zone) {
  REAL(int, gettimeofday, struct timeval*, void*);
  const int result = real_gettimeofday(now, zone);
  if (result == 0) now->tv_sec += clock_shift;
  return result;
}
