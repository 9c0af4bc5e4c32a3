// SPDX-License-Identifier: MIT
// For LD_PRELOAD: one call of a program's to the system fails, as calls do on full disks, broken cables and
// computers without memory. What counts is chosen by the environment:
//   RELUCENT_FAULT_FOLDER  calls on files below it, and on nothing else, count
//   RELUCENT_FAULT_BYTES   instead: pieces of memory of at least that many bytes count
//   RELUCENT_FAULT_MOST_BYTES  and of no more than these, if it is not 0
//   RELUCENT_FAULT_CALL    which one fails, from 1; 0: none
//   RELUCENT_FAULT_CODE    ENOSPC, EIO, EACCES, EMFILE or ENOMEM; EIO where a call never ends in that
//   RELUCENT_FAULT_STAYS   1: all calls after it fail as well
//   RELUCENT_FAULT_LOG     a file for what counted: a line for the call that fails, and at the end the number
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

// glibc's own, which need nobody to look for them: looking takes memory.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

struct Wish {
  char folder[1024] = "", log[1024] = "";
  std::size_t folderLength = 0, bytes = 0, mostBytes = 0;
  long call = 0;
  int code = EIO;
  bool stays = false, isMemory = false, isReady = false;
};
Wish wish;
std::atomic<long> calls{0};

int codeNamed(const char* name) {
  constexpr struct {
    const char* name;
    int code;
  } all[]{{"ENOSPC", ENOSPC}, {"EIO", EIO}, {"EACCES", EACCES}, {"EMFILE", EMFILE}, {"ENOMEM", ENOMEM}};
  for (const auto& each : all)
    if (std::strcmp(each.name, name) == 0) return each.code;
  return EIO;
}

const char* asked(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

/// Before main(), and before anything counts.
__attribute__((constructor)) void readWishes() {
  std::strncpy(wish.folder, asked("RELUCENT_FAULT_FOLDER"), sizeof wish.folder - 1);
  std::strncpy(wish.log, asked("RELUCENT_FAULT_LOG"), sizeof wish.log - 1);
  wish.folderLength = std::strlen(wish.folder);
  wish.bytes = std::strtoul(asked("RELUCENT_FAULT_BYTES"), nullptr, 10);
  wish.mostBytes = std::strtoul(asked("RELUCENT_FAULT_MOST_BYTES"), nullptr, 10);
  wish.isMemory = wish.bytes > 0;
  wish.call = std::strtol(asked("RELUCENT_FAULT_CALL"), nullptr, 10);
  wish.code = codeNamed(asked("RELUCENT_FAULT_CODE"));
  wish.stays = std::strcmp(asked("RELUCENT_FAULT_STAYS"), "1") == 0;
  wish.isReady = wish.folderLength > 0 || wish.isMemory;
}

/// By the system's own call: the others count.
void log(const char* line) {
  if (wish.log[0] == '\0') return;
  const long file =
      ::syscall(SYS_openat, AT_FDCWD, wish.log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) return;
  ::syscall(SYS_write, file, line, std::strlen(line));
  ::syscall(SYS_close, file);
}

__attribute__((destructor)) void tellCount() {
  if (!wish.isReady) return;
  char line[64];
  std::snprintf(line, sizeof line, "calls %ld\n", calls.load());
  log(line);
}

bool isWatched(const char* path) {
  return wish.folderLength > 0 && path != nullptr &&
         std::strncmp(path, wish.folder, wish.folderLength) == 0 &&
         (path[wish.folderLength] == '/' || path[wish.folderLength] == '\0');
}

/// The path of an open file; false: it has none.
bool pathOf(int file, char* path, std::size_t room) {
  char link[64];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const long length = ::syscall(SYS_readlinkat, AT_FDCWD, link, path, room - 1);
  if (length <= 0) return false;
  path[length] = '\0';
  return true;
}

/// Of what open(), mkdir() and others are given.
void absolute(int folder, const char* path, char* out, std::size_t room) {
  if (path[0] == '/') {
    std::snprintf(out, room, "%s", path);
    return;
  }
  char base[2048] = "";
  if (folder == AT_FDCWD)
    ::syscall(SYS_getcwd, base, sizeof base);
  else
    pathOf(folder, base, sizeof base);
  std::snprintf(out, room, "%s/%s", base, path);
}

enum Ends { noSpace = 1, denied = 2, noHandle = 4, noMemory = 8 };

/// Whether the call is the one that fails; errno is then set. `ends`: in which it may end besides EIO.
bool fails(const char* call, const char* path, int ends) {
  const long number = ++calls;
  if (wish.call <= 0 || (wish.stays ? number < wish.call : number != wish.call)) return false;
  const bool mayEnd =
      (wish.code == ENOSPC && (ends & noSpace) != 0) || (wish.code == EACCES && (ends & denied) != 0) ||
      (wish.code == EMFILE && (ends & noHandle) != 0) || (wish.code == ENOMEM && (ends & noMemory) != 0);
  const int code = mayEnd ? wish.code : EIO;
  char line[3000];
  std::snprintf(line, sizeof line, "%s %s %d\n", call, path, code);
  log(line);
  errno = code;
  return true;
}

bool failsOn(const char* call, const char* path, int ends, int folder = AT_FDCWD) {
  if (!wish.isReady || wish.isMemory || path == nullptr) return false;
  char whole[4096];
  absolute(folder, path, whole, sizeof whole);
  return isWatched(whole) && fails(call, whole, ends);
}

bool failsOnFile(const char* call, int file, int ends) {
  if (!wish.isReady || wish.isMemory) return false;
  char path[2048];
  return pathOf(file, path, sizeof path) && isWatched(path) && fails(call, path, ends);
}

bool failsToTake(std::size_t bytes) {
  if (!wish.isReady || !wish.isMemory || bytes < wish.bytes) return false;
  if (wish.mostBytes > 0 && bytes > wish.mostBytes) return false;
  char text[32];
  std::snprintf(text, sizeof text, "%zu", bytes);
  if (!fails("memory", text, noMemory)) return false;
  errno = ENOMEM;
  return true;
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

constexpr int ofOpening = denied | noHandle | noSpace;

int endsOfOpen(int flags) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? ofOpening : denied | noHandle;
}

int modeIn(int flags, std::va_list arguments) {
  return (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE ? va_arg(arguments, int) : 0;
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

#define RELUCENT_OPEN(name)                                                \
  int name(const char* path, int flags, ...) {                             \
    std::va_list arguments;                                                \
    va_start(arguments, flags);                                            \
    const int mode = modeIn(flags, arguments);                             \
    va_end(arguments);                                                     \
    if (failsOn("open", path, endsOfOpen(flags))) return -1;               \
    static auto* const original = real<int(const char*, int, ...)>(#name); \
    return original(path, flags, mode);                                    \
  }
RELUCENT_OPEN(open)
RELUCENT_OPEN(open64)

#define RELUCENT_OPENAT(name)                                                   \
  int name(int folder, const char* path, int flags, ...) {                      \
    std::va_list arguments;                                                     \
    va_start(arguments, flags);                                                 \
    const int mode = modeIn(flags, arguments);                                  \
    va_end(arguments);                                                          \
    if (failsOn("open", path, endsOfOpen(flags), folder)) return -1;            \
    static auto* const original = real<int(int, const char*, int, ...)>(#name); \
    return original(folder, path, flags, mode);                                 \
  }
RELUCENT_OPENAT(openat)
RELUCENT_OPENAT(openat64)

#define RELUCENT_FOPEN(name)                                                                   \
  FILE* name(const char* path, const char* mode) {                                             \
    if (failsOn("open", path, mode[0] == 'r' ? denied | noHandle : ofOpening)) return nullptr; \
    static auto* const original = real<FILE*(const char*, const char*)>(#name);                \
    return original(path, mode);                                                               \
  }
RELUCENT_FOPEN(fopen)
RELUCENT_FOPEN(fopen64)

ssize_t write(int file, const void* bytes, std::size_t count) {
  if (failsOnFile("write", file, noSpace)) return -1;
  return ::syscall(SYS_write, file, bytes, count);
}
ssize_t writev(int file, const iovec* parts, int count) {
  if (failsOnFile("write", file, noSpace)) return -1;
  return ::syscall(SYS_writev, file, parts, count);
}
ssize_t pwrite(int file, const void* bytes, std::size_t count, off_t at) {
  if (failsOnFile("pwrite", file, noSpace)) return -1;
  return ::syscall(SYS_pwrite64, file, bytes, count, at);
}
ssize_t pwrite64(int file, const void* bytes, std::size_t count, off64_t at) {
  if (failsOnFile("pwrite", file, noSpace)) return -1;
  return ::syscall(SYS_pwrite64, file, bytes, count, at);
}
/// What a stream holds may only be written when it is closed: both count.
std::size_t fwrite(const void* bytes, std::size_t size, std::size_t count, FILE* stream) {
  if (failsOnFile("fwrite", ::fileno(stream), noSpace)) return 0;
  static auto* const original = real<std::size_t(const void*, std::size_t, std::size_t, FILE*)>("fwrite");
  return original(bytes, size, count, stream);
}
int fclose(FILE* stream) {
  const int flags = ::fcntl(::fileno(stream), F_GETFL);
  const bool failed = (flags & O_ACCMODE) != O_RDONLY && failsOnFile("fclose", ::fileno(stream), noSpace);
  const int code = errno;
  static auto* const original = real<int(FILE*)>("fclose");
  const int result = original(stream);
  if (!failed) return result;
  errno = code;
  return EOF;
}
int fsync(int file) {
  return failsOnFile("fsync", file, noSpace) ? -1 : static_cast<int>(::syscall(SYS_fsync, file));
}
int fdatasync(int file) {
  return failsOnFile("fsync", file, noSpace) ? -1 : static_cast<int>(::syscall(SYS_fdatasync, file));
}
int ftruncate(int file, off_t length) {
  return failsOnFile("ftruncate", file, noSpace) ? -1
                                                 : static_cast<int>(::syscall(SYS_ftruncate, file, length));
}
int ftruncate64(int file, off64_t length) {
  return failsOnFile("ftruncate", file, noSpace) ? -1
                                                 : static_cast<int>(::syscall(SYS_ftruncate, file, length));
}
int posix_fallocate(int file, off_t at, off_t length) {
  if (failsOnFile("posix_fallocate", file, noSpace)) return errno;
  static auto* const original = real<int(int, off_t, off_t)>("posix_fallocate");
  return original(file, at, length);
}
int posix_fallocate64(int file, off64_t at, off64_t length) {
  if (failsOnFile("posix_fallocate", file, noSpace)) return errno;
  static auto* const original = real<int(int, off64_t, off64_t)>("posix_fallocate64");
  return original(file, at, length);
}
int rename(const char* from, const char* to) {
  if (failsOn("rename", to, noSpace | denied)) return -1;
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}
int mkdir(const char* path, mode_t mode) {
  if (failsOn("mkdir", path, noSpace | denied)) return -1;
  return static_cast<int>(::syscall(SYS_mkdirat, AT_FDCWD, path, mode));
}

#define RELUCENT_MMAP(name, offset)                                                                \
  void* name(void* at, std::size_t bytes, int protection, int flags, int file, offset from) {      \
    const bool failed =                                                                            \
        (flags & MAP_ANONYMOUS) != 0 ? failsToTake(bytes) : failsOnFile("mmap", file, noMemory);   \
    if (failed) return MAP_FAILED;                                                                 \
    return reinterpret_cast<void*>(::syscall(SYS_mmap, at, bytes, protection, flags, file, from)); \
  }
RELUCENT_MMAP(mmap, off_t)
RELUCENT_MMAP(mmap64, off64_t)

void* malloc(std::size_t bytes) {
  return failsToTake(bytes) ? nullptr : __libc_malloc(bytes);
}
void* calloc(std::size_t count, std::size_t size) {
  return failsToTake(count * size) ? nullptr : __libc_calloc(count, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
  return failsToTake(bytes) ? nullptr : __libc_memalign(alignment, bytes);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t bytes) {
  if (failsToTake(bytes)) return ENOMEM;
  *memory = __libc_memalign(alignment, bytes);
  return *memory != nullptr ? 0 : ENOMEM;
}

}  // extern "C"
#pragma GCC visibility pop
