#include "tests/lean/counted_program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <regex>

#include "schemas/failure.hpp"
#include "schemas/hdf.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola::testing {
namespace {

void datasets_below(const HdfReader& file, const std::string& object, std::set<std::string>& datasets) {
  std::vector<std::string> below;
  try {
    below = file.names(object);
  } catch (const Failure&) {  // not a group
    datasets.insert(object);
    return;
  }
  for (const std::string& name : below) datasets_below(file, object + (object == "/" ? "" : "/") + name, datasets);
}

}  // namespace

bool Counted::calls(const std::string& pattern) const {
  const std::regex wanted(pattern);
  return std::any_of(called.begin(), called.end(),
                     [&](const std::string& name) { return std::regex_search(name, wanted); });
}

Counted count(const std::string& program, const std::filesystem::path& folder, const std::string& part) {
  const std::filesystem::path calls = folder / "callgrind.log";
  // The variable without which the program would start itself anew, which valgrind does not take.
  const std::string command = fmt::format(
      "WM_PROJECT_DIR=/usr/share/openfoam valgrind --tool=callgrind --compress-strings=no --callgrind-out-file='{}' "
      "'{}' "
      "'{}' > '{}' 2>&1",
      calls.string(), program, folder.string(), (folder / "valgrind.log").string());
  EXPECT_EQ(std::system(command.c_str()), 0) << folder << ": see valgrind.log and stage.log";
  Counted counted;
  std::ifstream file(calls);
  bool of_the_part = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("fn=")) counted.called.insert(line.substr(3));
    if (line.starts_with("cfn=")) of_the_part = line.substr(4) == part;
    if (!line.starts_with("calls=")) continue;
    std::getline(file, line);  // where the call stands, and all that it cost
    if (of_the_part) counted.instructions += std::stod(line.substr(line.find(' ')));
  }
  EXPECT_GT(counted.instructions, 0) << part << " was not called";
  for (const char* name : {"result.hdf", "checkpoint-A.h5", "checkpoint-B.h5"})
    if (std::filesystem::exists(folder / name)) datasets_below(HdfReader(folder / name), "/", counted.written);
  EXPECT_FALSE(counted.written.empty());
  return counted;
}

bool has_function(const std::string& program, const std::string& pattern) {
  const TemporaryFolder folder;
  const std::filesystem::path names = folder.path() / "names";
  if (std::system(fmt::format("nm --demangle '{}' > '{}'", program, names.string()).c_str()) != 0) return false;
  const std::regex wanted(" [TtWw] .*" + pattern);
  std::ifstream file(names);
  for (std::string line; std::getline(file, line);)
    if (std::regex_search(line, wanted)) return true;
  return false;
}

}  // namespace cupola::testing
