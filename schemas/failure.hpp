#pragma once
#include <map>
#include <stdexcept>
#include <string>

namespace cupola {

/// Exit status of the three programs (docs/developers/contracts.md).
enum class ExitCode : int {
  done = 0,
  wrong_input = 65,   ///< the campaign, the task or a file it names is wrong: says which key and what to do
  diverged = 70,      ///< the numbers went bad: says step, cell or parcel, and what to change
  held = 73,          ///< another process writes in this folder
  input_output = 74,  ///< a file could not be read or written
  stopped = 75,       ///< stopped on request or not yet converged: run again to go on
};

/// The one exception of ours that ends a program: a sentence for a person and a status for a script.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}

  /// Where it happened (`step`, `cell`, `parcel`, `file`, …) and what to change (`campaign key` -> value).
  Failure& at(const std::string& what, const std::string& value) {
    where_[what] = value;
    return *this;
  }
  Failure& advise(const std::string& key, const std::string& value) {
    advice_[key] = value;
    return *this;
  }

  [[nodiscard]] ExitCode code() const { return code_; }
  [[nodiscard]] const std::map<std::string, std::string>& where() const { return where_; }
  [[nodiscard]] const std::map<std::string, std::string>& advice() const { return advice_; }

 private:
  ExitCode code_;
  std::map<std::string, std::string> where_;
  std::map<std::string, std::string> advice_;
};

}  // namespace cupola
