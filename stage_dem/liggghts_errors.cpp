// LIGGGHTS ends the process on an error, silently where its logs are off.  These definitions, linked into the program
// itself, take the place of the library's: the host throws instead, with LIGGGHTS' own sentence.  An OBJECT library in
// CMake, because a linker leaves out what nobody names in a static one.
#include <fmt/format.h>
#include <liggghts/compute.h>
#include <liggghts/error.h>
#include <liggghts/fix.h>

#include "schemas/failure.hpp"

namespace {

[[noreturn]] void fail(const std::string& sentence, const char* file, int line) {
  throw cupola::Failure(cupola::ExitCode::diverged, "LIGGGHTS: " + sentence)
      .at("source", fmt::format("{}:{}", file, line));
}

}  // namespace

namespace LAMMPS_NS {

void Error::all(const char* file, int line, const char* sentence) { fail(sentence, file, line); }

void Error::one(const char* file, int line, const char* sentence) { fail(sentence, file, line); }

void Error::fix_error(const char* file, int line, Fix* fix, const char* sentence) {
  fail(fmt::format("fix {} ({}): {}", fix->id, fix->style, sentence), file, line);
}

void Error::fix_error(const char* file, int line, Fix* fix, const char* style, const char* sentence) {
  fail(fmt::format("fix {} ({}): {}", fix->id, style, sentence), file, line);
}

void Error::compute_error(const char* file, int line, Compute* compute, const char* sentence) {
  fail(fmt::format("compute {} ({}): {}", compute->id, compute->style, sentence), file, line);
}

}  // namespace LAMMPS_NS
