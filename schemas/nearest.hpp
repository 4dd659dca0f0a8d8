#pragma once
#include <optional>
#include <string>
#include <vector>

namespace cupola {

/// The known word nearest to a misspelt one (edits: insert, delete, replace, swap neighbours), if it is near enough to
/// be meant: at most one edit for every three letters.
std::optional<std::string> nearest_word(const std::string& misspelt, const std::vector<std::string>& known);

/// ` (did you mean `word`?)`, or nothing.
std::string suggestion(const std::string& misspelt, const std::vector<std::string>& known);

}  // namespace cupola
