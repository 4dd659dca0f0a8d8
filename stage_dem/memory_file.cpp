#include "stage_dem/memory_file.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "schemas/failure.hpp"

namespace cupola {
namespace {

[[noreturn]] void fail(const char* what) {
  throw Failure(ExitCode::input_output,
                fmt::format("a file in memory cannot be {}: {}; is the memory full?", what, std::strerror(errno)));
}

}  // namespace

MemoryFile::MemoryFile(const std::vector<std::uint8_t>& content) : descriptor_(::memfd_create("state", MFD_CLOEXEC)) {
  if (descriptor_ < 0) fail("made");
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t count = ::write(descriptor_, content.data() + done, content.size() - done);
    if (count < 0 && errno != EINTR) fail("written");
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::string MemoryFile::name() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

std::vector<std::uint8_t> MemoryFile::bytes() const {
  struct stat state {};
  if (::fstat(descriptor_, &state) != 0) fail("looked at");
  std::vector<std::uint8_t> content(static_cast<std::size_t>(state.st_size));
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t count = ::pread(descriptor_, content.data() + done, content.size() - done, static_cast<off_t>(done));
    if (count == 0 || (count < 0 && errno != EINTR)) fail("read");
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  return content;
}

}  // namespace cupola
