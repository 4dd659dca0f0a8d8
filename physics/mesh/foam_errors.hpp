#pragma once
#include <error.H>

#include <string>
#include <utility>

#include "schemas/failure.hpp"

namespace cupola {

/// The text of an OpenFOAM error without its frame of blank lines.
std::string foam_sentence(Foam::error& error);

/// Runs `work`; what OpenFOAM throws becomes a Failure that begins with what was being done.
template <typename Work>
auto with_foam_errors(ExitCode code, const std::string& doing, Work&& work) {
  Foam::FatalError.throwExceptions();
  Foam::FatalIOError.throwExceptions();
  try {
    return std::forward<Work>(work)();
  } catch (Foam::error& error) {  // Foam::IOerror too
    throw Failure(code, doing + ": " + foam_sentence(error));
  }
}

}  // namespace cupola
