#include "schemas/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "schemas/file_descriptor.hpp"

namespace cupola {

void throw_system_failure(const std::filesystem::path& file, const std::string& what) {
  throw Failure(ExitCode::input_output, fmt::format("{}: cannot {}: {}", file.string(), what, std::strerror(errno)))
      .at("file", file.string());
}

FileDescriptor::FileDescriptor(const std::filesystem::path& file, int flags)
    : file_(file), descriptor_(::open(file.c_str(), flags | O_CLOEXEC, 0644)) {
  if (descriptor_ < 0) {
    throw_system_failure(file_, "open");
  }
}

FileDescriptor::~FileDescriptor() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

int FileDescriptor::release() { return std::exchange(descriptor_, -1); }

void FileDescriptor::write(const std::string& text) const {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor_, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) {
      throw_system_failure(file_, "write");
    }
    done += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
}

std::size_t FileDescriptor::read(char* buffer, std::size_t count) const {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t taken = ::read(descriptor_, buffer + done, count - done);
    if (taken < 0 && errno != EINTR) {
      throw_system_failure(file_, "read");
    }
    if (taken == 0) break;
    done += taken > 0 ? static_cast<std::size_t>(taken) : 0;
  }
  return done;
}

void FileDescriptor::sync() const {
  if (::fsync(descriptor_) != 0 && errno != EINVAL) {
    throw_system_failure(file_, "sync");
  }
}

namespace {

/// Hands the file's bytes over piece by piece.
template <class Take>
void for_each_piece(const std::filesystem::path& file, Take take) {
  const FileDescriptor opened(file, O_RDONLY);
  std::vector<char> buffer(1U << 16U);
  while (const std::size_t count = opened.read(buffer.data(), buffer.size())) {
    take(buffer.data(), count);
  }
}

std::string to_hash_text(const XXH128_hash_t& hash) {
  return fmt::format("xxh3:{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

std::string hash_file(const std::filesystem::path& file) {
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
  XXH3_128bits_reset(state.get());
  for_each_piece(file, [&](const char* data, std::size_t count) { XXH3_128bits_update(state.get(), data, count); });
  return to_hash_text(XXH3_128bits_digest(state.get()));
}

std::string hash_text(const std::string& text) { return to_hash_text(XXH3_128bits(text.data(), text.size())); }

std::string read_text(const std::filesystem::path& file) {
  std::string text;
  for_each_piece(file, [&](const char* data, std::size_t count) { text.append(data, count); });
  return text;
}

std::filesystem::path temporary_beside(const std::filesystem::path& file) { return file.string() + ".part"; }

void publish(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  FileDescriptor(temporary, O_RDONLY).sync();
  if (std::rename(temporary.c_str(), file.c_str()) != 0) {
    throw_system_failure(file, "put in place");
  }
  const std::filesystem::path folder = file.parent_path();
  FileDescriptor(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY).sync();
}

void write_text_atomically(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path temporary = temporary_beside(file);
  FileDescriptor(temporary, O_WRONLY | O_CREAT | O_TRUNC).write(text);
  publish(temporary, file);
}

nlohmann::json read_json(const std::filesystem::path& file) {
  try {
    return nlohmann::json::parse(read_text(file));
  } catch (const nlohmann::json::parse_error& error) {
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: not whole JSON from byte {} on: the file is damaged. Put it back from a copy.",
                              file.string(), error.byte))
        .at("file", file.string());
  }
}

void write_json_atomically(const std::filesystem::path& file, const nlohmann::json& value) {
  write_text_atomically(file, value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

namespace {

constexpr const char* seal = "hash";

std::string one_line(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string sealed_text(const nlohmann::json& value) {
  return value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

void write_sealed_json(const std::filesystem::path& file, nlohmann::json object) {
  object.erase(seal);
  object[seal] = hash_text(one_line(object));
  write_text_atomically(file, sealed_text(object));
}

nlohmann::json read_sealed_json(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  nlohmann::json object = nlohmann::json::parse(text, nullptr, false);
  const auto damaged = [&] {
    return Failure(ExitCode::input_output,
                   fmt::format("{}: damaged, or changed after it was written: its content does not fit the hash it "
                               "carries. Put it back from a copy.",
                               file.string()))
        .at("file", file.string());
  };
  if (!object.is_object() || !object.contains(seal) || sealed_text(object) != text) throw damaged();
  const nlohmann::json hash = object[seal];
  object.erase(seal);
  if (hash != hash_text(one_line(object))) throw damaged();
  return object;
}

}  // namespace cupola
