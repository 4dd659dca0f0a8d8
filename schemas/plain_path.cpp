#include "schemas/plain_path.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <system_error>

#include "schemas/failure.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

bool is_plain(const std::string& path) {
  return std::all_of(path.begin(), path.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string("._-+/").find(c) != std::string::npos;
  });
}

std::filesystem::path place_for_links() {
  std::error_code ignored;
  const auto usual = std::filesystem::temp_directory_path(ignored);
  return is_plain(usual.string()) && !usual.empty() ? usual : "/tmp";
}

}  // namespace

PlainPath::PlainPath(const std::filesystem::path& folder)
    : path_(std::filesystem::absolute(folder).lexically_normal()) {
  if (is_plain(path_.string())) return;
  const std::filesystem::path target = path_;
  const std::string hash = hash_text(target.string());
  path_ = place_for_links() / fmt::format("cupola-{}-{}", ::getuid(), hash.substr(hash.find(':') + 1));
  std::error_code error;
  std::filesystem::create_directory_symlink(target, path_, error);
  is_own_link_ = !error;
  // Another rank, or a program that was killed, may have made it.
  std::error_code unreadable;
  if (error && std::filesystem::read_symlink(path_, unreadable) != target)
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: OpenFOAM and LIGGGHTS need a path without blanks and special letters, and a link to "
                              "it cannot be made at {}: {}. Choose a folder with a plain path.",
                              target.string(), path_.string(), error.message()))
        .at("file", target.string());
}

PlainPath::~PlainPath() {
  if (!is_own_link_) return;
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace cupola
