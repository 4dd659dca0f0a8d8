#include "schemas/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cupola {
namespace {

constexpr std::size_t longest_word = 64;

/// Edit distance of optimal string alignment.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::vector<std::size_t> next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        next[j] = std::min(next[j], before[j - 2] + 1);
    }
    std::swap(before, row);
    std::swap(row, next);
  }
  return row[b.size()];
}

}  // namespace

std::optional<std::string> nearest_word(const std::string& misspelt, const std::vector<std::string>& known) {
  if (misspelt.size() > longest_word) return std::nullopt;
  std::optional<std::string> nearest;
  std::size_t least = std::max<std::size_t>(1, misspelt.size() / 3) + 1;
  for (const auto& word : known) {
    const auto distance = edits(misspelt, word);
    if (distance < least) {
      least = distance;
      nearest = word;
    }
  }
  return nearest;
}

std::string suggestion(const std::string& misspelt, const std::vector<std::string>& known) {
  const auto word = nearest_word(misspelt, known);
  return word ? fmt::format(" (did you mean `{}`?)", *word) : "";
}

}  // namespace cupola
