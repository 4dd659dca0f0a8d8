#include "schemas/plain_path.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "schemas/file_descriptor.hpp"

namespace cupola {
namespace {

// OpenFOAM's master tells the other ranks its path: from here up the number is the same on all of them.
constexpr int least_descriptor = 500;

bool is_plain(const std::string& name) {
  return std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) != 0 ||
           std::string_view("/._-+=,:@%~").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

}  // namespace

PlainPath::PlainPath(const std::filesystem::path& folder) : path_(folder) {
  if (is_plain(std::filesystem::absolute(folder).string())) return;
  const FileDescriptor opened(folder, O_PATH | O_DIRECTORY);
  descriptor_ = ::fcntl(opened.get(), F_DUPFD, least_descriptor);
  if (descriptor_ < 0) throw_system_failure(folder, "open");
  path_ = "/proc/self/fd/" + std::to_string(descriptor_);
}

PlainPath::~PlainPath() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace cupola
