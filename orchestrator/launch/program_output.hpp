#pragma once
#include <chrono>
#include <string>
#include <vector>

namespace cupola {

/// What a short program said.
struct ProgramOutput {
  int status = 0;      ///< its exit status, 128 + signal where one ended it, 127 where it is not there
  std::string output;  ///< standard output
  std::string error;   ///< standard error
};

/// Runs a short program to its end, without a shell; a Ctrl-C at our terminal does not reach it.
/// @param patience after which it is killed: status 137 and a sentence in `error`
/// @throws Failure input_output where no process can be made
ProgramOutput output_of(const std::vector<std::string>& words, std::chrono::seconds patience);

}  // namespace cupola
