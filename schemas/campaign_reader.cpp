#include "schemas/campaign_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "schemas/campaign_from_document.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "schemas/schema_check.hpp"

namespace cupola {
namespace {

constexpr std::size_t largest_file = 1 << 20;

void put_in_order(std::vector<CampaignError>& errors) {
  const auto key = [](const CampaignError& e) { return std::tie(e.line, e.column, e.key, e.message); };
  std::sort(errors.begin(), errors.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  errors.erase(
      std::unique(errors.begin(), errors.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
      errors.end());
}

}  // namespace

ReadCampaign read_campaign_document(YamlDocument document) {
  ReadCampaign result;
  if (document.complete && document.root.is_object()) {
    static const SchemaValidator validator(nlohmann::json::parse(campaign_schema()));
    check_against_schema(document, validator);
    result.campaign = campaign_from_document(document);
    check_meaning(result.campaign, document);
  } else if (document.errors.empty()) {
    document.errors.push_back(document.error_at("", "expected a section of keys, beginning with `campaign: name`"));
  }
  put_in_order(document.errors);
  result.errors = std::move(document.errors);
  return result;
}

ReadCampaign read_campaign_text(const std::string& text, const std::string& file_name) {
  if (text.size() > largest_file)
    return {{}, {{file_name, 1, 1, "", "the file is larger than 1 MB: this is no campaign file"}}};
  if (text.find('\0') != std::string::npos)
    return {{}, {{file_name, 1, 1, "", "the file holds bytes that are no text: this is no campaign file"}}};
  return read_campaign_document(parse_yaml(text, file_name));
}

ReadCampaign read_campaign(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) {
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: there is no such file; `cupola init DIR` writes one to begin with", file.string()))
        .at("file", file.string());
  }
  if (std::filesystem::is_directory(file)) {
    throw Failure(ExitCode::input_output, fmt::format("{}: a folder; name the campaign file in it", file.string()))
        .at("file", file.string());
  }
  return read_campaign_text(read_text(file), file.string());
}

Campaign load_campaign(const std::filesystem::path& file) {
  auto result = read_campaign(file);
  if (!result.ok()) throw Failure(ExitCode::wrong_input, to_text(result.errors)).at("file", file.string());
  return std::move(result.campaign);
}

std::string to_text(const std::vector<CampaignError>& errors) {
  std::string text;
  for (const auto& error : errors) {
    text += fmt::format("{}:{}:{}: {}{}{}\n", error.file, error.line, error.column, error.key,
                        error.key.empty() ? "" : ": ", error.message);
  }
  return text;
}

}  // namespace cupola
