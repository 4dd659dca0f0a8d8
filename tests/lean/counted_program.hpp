#pragma once
#include <filesystem>
#include <set>
#include <string>

/// A program under callgrind: which of its functions were called at all, and how many instructions a part of it took.
namespace cupola::testing {

struct Counted {
  std::set<std::string> called;   ///< functions, with their arguments
  double instructions = 0;        ///< of the part that was asked for, with all that it calls
  std::set<std::string> written;  ///< datasets of the result and of the checkpoints
  /// Was a function called whose name matches (ECMAScript)?
  [[nodiscard]] bool calls(const std::string& pattern) const;
};

/// Runs `program FOLDER` on one rank; a failed run is a failed test.
/// @param part function whose instructions are counted, as callgrind writes it
Counted count(const std::string& program, const std::filesystem::path& folder, const std::string& part);

/// Does the program have a function whose name matches?  What has been renamed cannot be found to be uncalled.
bool has_function(const std::string& program, const std::string& pattern);

}  // namespace cupola::testing
