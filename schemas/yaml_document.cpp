#include "schemas/yaml_document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <sstream>

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t deepest_level = 64;
constexpr std::size_t most_values = 100000;

Place place_of(const YAML::Mark& mark) { return {std::max(mark.line, 0) + 1, std::max(mark.column, 0) + 1}; }

template <typename Number>
std::optional<Number> whole_number(const std::string& text) {
  Number number{};
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc() || end != last) return std::nullopt;
  return number;
}

/// A plain scalar as YAML's core schema reads it; what is not a finite number stays a text.
Json plain_scalar(const std::string& text) {
  if (text == "~" || text == "null" || text == "Null" || text == "NULL") return nullptr;
  if (text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "false" || text == "False" || text == "FALSE") return false;
  if (text != "-0") {  // the integer zero has no sign
    if (const auto integer = whole_number<std::int64_t>(text)) return *integer;
    if (const auto integer = whole_number<std::uint64_t>(text)) return *integer;
  }
  if (const auto number = whole_number<double>(text); number && std::isfinite(*number)) return *number;
  return text;
}

/// Builds the JSON value from the parser's events, so that an alias can never become an endless tree.
class Builder : public YAML::EventHandler {
 public:
  explicit Builder(YamlDocument& document) : document_(document) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { scalar(mark, nullptr, ""); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw YAML::ParserException(mark, "aliases (`*name`) are not allowed: write the value out");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, const std::string& value) override {
    scalar(mark, tag == "?" || tag.empty() ? plain_scalar(value) : Json(value), value);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    open(mark, Json::array());
  }
  void OnSequenceEnd() override { levels_.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    open(mark, Json::object());
  }
  void OnMapEnd() override { levels_.pop_back(); }

 private:
  struct Level {
    Json* value;
    std::string path;
    std::optional<std::string> key;  ///< of a map: the key whose value comes next
    bool repeated = false;           ///< that key stood before: its value is dropped
  };

  void scalar(const YAML::Mark& mark, Json value, const std::string& text) {
    if (!levels_.empty() && levels_.back().value->is_object() && !levels_.back().key) {
      take_key(mark, text);
    } else {
      put(mark, std::move(value));
    }
  }

  void take_key(const YAML::Mark& mark, const std::string& key) {
    auto& level = levels_.back();
    const auto path = path_of(level.path, key);
    level.key = key;
    level.repeated = level.value->contains(key);
    if (level.repeated) {
      const auto first = document_.keys[path];
      document_.errors.push_back(
          {document_.file, place_of(mark).line, place_of(mark).column, path,
           fmt::format("`{}` stands here a second time; the first is in line {}", key, first.line)});
    } else {
      document_.keys[path] = place_of(mark);
    }
  }

  void open(const YAML::Mark& mark, Json empty) {
    if (levels_.size() >= deepest_level) throw YAML::ParserException(mark, "more levels than any campaign needs");
    if (!levels_.empty() && levels_.back().value->is_object() && !levels_.back().key) {
      throw YAML::ParserException(mark, "a key must be a plain word");
    }
    auto [value, path] = put(mark, std::move(empty));
    levels_.push_back({value, path, std::nullopt});
  }

  std::pair<Json*, std::string> put(const YAML::Mark& mark, Json value) {
    if (++count_ > most_values) throw YAML::ParserException(mark, "more values than any campaign needs");
    if (levels_.empty()) {
      document_.root = std::move(value);
      document_.values[""] = place_of(mark);
      return {&document_.root, ""};
    }
    auto& level = levels_.back();
    if (level.value->is_array()) {
      const auto path = path_of(level.path, level.value->size());
      document_.values[path] = place_of(mark);
      level.value->push_back(std::move(value));
      return {&level.value->back(), path};
    }
    const auto key = *level.key;
    level.key.reset();
    const auto path = path_of(level.path, key);
    if (level.repeated) {
      return {&dropped_.emplace_back(std::move(value)), path};
    }
    document_.values[path] = place_of(mark);
    return {&((*level.value)[key] = std::move(value)), path};
  }

  YamlDocument& document_;
  std::vector<Level> levels_;
  std::deque<Json> dropped_;
  std::size_t count_ = 0;
};

bool has_tab(const std::string& text, int line) {
  std::istringstream lines(text);
  std::string current;
  for (int i = 0; i <= line && std::getline(lines, current); ++i) {
  }
  return current.find('\t') != std::string::npos;
}

}  // namespace

std::string path_of(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}
std::string path_of(const std::string& parent, std::size_t index) { return fmt::format("{}[{}]", parent, index); }

CampaignError YamlDocument::error_at(const std::string& path, const std::string& message) const {
  auto around = path;
  auto found = values.find(around);
  while (found == values.end() && !around.empty()) {
    const auto cut = around.find_last_of(".[");
    around.resize(cut == std::string::npos ? 0 : cut);
    found = values.find(around);
  }
  const auto place = found == values.end() ? Place{} : found->second;
  return {file, place.line, place.column, path, message};
}

CampaignError YamlDocument::error_at_key(const std::string& path, const std::string& message) const {
  const auto found = keys.find(path);
  if (found == keys.end()) return error_at(path, message);
  return {file, found->second.line, found->second.column, path, message};
}

YamlDocument YamlDocument::below(const std::string& key) const {
  YamlDocument part{file, root.at(key), {}, {}, {}, complete};
  const auto cut = [&](const std::map<std::string, Place>& from, std::map<std::string, Place>& to) {
    for (const auto& [path, place] : from) {
      if (path == key) to[""] = place;
      if (path.starts_with(key + ".")) to[path.substr(key.size() + 1)] = place;
    }
  };
  cut(keys, part.keys);
  cut(values, part.values);
  return part;
}

YamlDocument parse_yaml(const std::string& text, const std::string& file_name) {
  YamlDocument document{file_name, nullptr, {}, {}, {}, false};
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    Builder builder(document);
    if (!parser.HandleNextDocument(builder)) {
      document.errors.push_back({file_name, 1, 1, "", "the file is empty"});
    } else if (Builder rest(document); parser.HandleNextDocument(rest)) {
      document.errors.push_back({file_name, 1, 1, "", "one document was expected, but a second one begins with `---`"});
    } else {
      document.complete = true;
    }
  } catch (const YAML::Exception& exception) {
    const auto place = place_of(exception.mark);
    const auto* hint = has_tab(text, place.line - 1) ? " (there is a tab in this line: YAML indents with blanks)" : "";
    document.errors.push_back({file_name, place.line, place.column, "", "this is not YAML: " + exception.msg + hint});
  }
  return document;
}

}  // namespace cupola
