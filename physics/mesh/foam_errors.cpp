#include "physics/mesh/foam_errors.hpp"

#include <IOstreams.H>

#include <sstream>

namespace cupola {

std::string foam_sentence(Foam::error& error) {
  std::istringstream words(error.message());
  std::string sentence;
  for (std::string word; words >> word;) sentence += (sentence.empty() ? "" : " ") + word;
  return sentence;
}

}  // namespace cupola
