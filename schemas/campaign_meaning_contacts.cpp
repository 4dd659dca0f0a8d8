#include <map>
#include <set>

#include "schemas/campaign_meaning.hpp"
#include "schemas/nearest.hpp"

namespace cupola::meaning {

void check_contacts(Context& context) {
  if (context.campaign.contacts.model == Contacts::Model::linear_spring && context.has("contacts") &&
      !context.has("contacts.stiffness")) {
    context.add("contacts", "the model linear-spring needs `stiffness` (like 1e4 N/m)");
  }
  const auto& contacts = context.campaign.contacts;
  const bool hertz = contacts.model == Contacts::Model::hertz;
  if (hertz && context.has("contacts.stiffness_of"))
    context.add("contacts.stiffness_of", "only linear springs have a stiffness (contacts.model: linear-spring)");
  if (contacts.rolling_model != Contacts::Rolling::epsd && context.has("contacts.rolling_damping"))
    context.add("contacts.rolling_damping", "only the model epsd damps rolling (contacts.rolling_model: epsd)");
  constexpr double least_modulus = 1e5;  // a bed of a metre would press softer parcels flat
  for (const auto& [key, modulus] : {std::pair{"contacts.youngs_modulus", contacts.youngs_modulus},
                                     std::pair{"contacts.wall_youngs_modulus", contacts.wall_youngs_modulus}}) {
    if (hertz && modulus < least_modulus) {
      context.add(key, "{} Pa is softer than 0.1 MPa: parcels would sink into each other under their own weight",
                  modulus);
    }
  }
  constexpr double least_restitution = 0.05;  // the damping of a Hertz contact is not defined below, says LIGGGHTS
  for (const auto& [pair, contact] : contacts.pairs) {
    if (hertz && contact.restitution <= least_restitution) {
      context.add(path_of(path_of("contacts.pairs", pair), "restitution"),
                  "{} is too small for Hertz contacts: it must exceed 0.05 (linear springs take less)",
                  contact.restitution);
    }
  }
  const auto& root = context.document.root;
  // Not `context.has`: a misplaced key may be called `contacts.pairs`.
  const nlohmann::ordered_json::json_pointer pairs("/contacts/pairs");
  if (!context.named || context.names.empty() || !root.contains(pairs) || !root.at(pairs).is_object()) return;
  std::set<std::string> wanted;
  std::vector<std::string> candidates;  // both orders
  auto partners = context.names;
  partners.emplace_back("wall");
  for (std::size_t i = 0; i < context.names.size(); ++i) {
    for (std::size_t j = i; j < partners.size(); ++j) {
      wanted.insert(context.names[i] + "-" + partners[j]);
      candidates.push_back(context.names[i] + "-" + partners[j]);
      candidates.push_back(partners[j] + "-" + context.names[i]);
    }
  }
  const auto in_order = [&](const std::string& pair) {
    const auto dash = pair.find('-');
    if (wanted.contains(pair) || dash == std::string::npos) return pair;
    return pair.substr(dash + 1) + "-" + pair.substr(0, dash);
  };

  std::map<std::string, std::string> given;  // as it is spelt, by the pair in order
  std::set<std::string> meant;
  for (const auto& [key, value] : root.at(pairs).items()) {
    const auto pair = in_order(key);
    const auto path = path_of("contacts.pairs", key);
    if (!wanted.contains(pair)) {
      if (const auto near = nearest_word(key, candidates)) meant.insert(in_order(*near));
      context.add_at_key(path, "`{}` is no pair of species, or of a species and `wall`{}", key,
                         suggestion(key, candidates));
    } else if (const auto [first, fresh] = given.emplace(pair, key); !fresh) {
      context.add_at_key(path, "this pair stands here a second time; the first is `{}`", first->second);
    }
  }
  for (const auto& pair : wanted) {
    if (!given.contains(pair) && !meant.contains(pair))
      context.add_at_key("contacts.pairs", "the pair `{}` is missing", pair);
  }
}

}  // namespace cupola::meaning
