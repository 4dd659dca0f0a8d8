#include "orchestrator/report/charts.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "orchestrator/report/json_numbers.hpp"
#include "orchestrator/report/mid_plane.hpp"
#include "schemas/field_file.hpp"

namespace cupola {

using nlohmann::json;

namespace {

constexpr int digits_drawn = 5;

/// Lines of a history as columns: name of the column -> pointer into a line.
json columns_of(const StageReport& stage, const std::map<std::string, std::string>& pointers) {
  json columns = {{"episode", stage.episode}};
  for (const auto& [name, pointer] : pointers) {
    json values = json::array();
    bool any = false;
    for (const json& line : stage.history) {
      const std::optional<double> value = number_at(line, pointer);
      any = any || value.has_value();
      values.push_back(value ? rounded(*value) : json(nullptr));
    }
    if (any || name == "time") {
      columns[name] = std::move(values);
    }
  }
  return columns;
}

/// Area-weighted mean of the finite heights of one x.
struct ColumnMean {
  double area = 0, sum = 0;
  void add(double height, double weight) {
    if (std::isfinite(height)) {
      area += weight;
      sum += weight * height;
    }
  }
  [[nodiscard]] json value() const { return area > 0 ? rounded(sum / area) : json(nullptr); }
};

json cohesive_zone(const StageReport& stage) {
  const HdfReader file(stage.result());
  const std::vector<double> x = file.doubles("CohesiveZone/x");
  const auto rows = static_cast<std::int64_t>(x.size());
  const std::vector<double> area = file.doubles("CohesiveZone/area", rows);
  const std::vector<double> melted = file.doubles("CohesiveZone/height_melted", rows);
  const std::vector<double> softened = file.doubles("CohesiveZone/height_softened", rows);
  constexpr double micrometre = 1e-6;
  std::map<long long, std::pair<ColumnMean, ColumnMean>> means;
  for (std::size_t i = 0; i < x.size(); ++i) {
    auto& [mean_melted, mean_softened] = means[std::llround(x[i] / micrometre)];
    mean_melted.add(melted[i], area[i]);
    mean_softened.add(softened[i], area[i]);
  }
  json zone = {{"episode", stage.episode},
               {"x", json::array()},
               {"height_melted", json::array()},
               {"height_softened", json::array()}};
  for (const auto& [place, heights] : means) {
    zone["x"].push_back(rounded(static_cast<double>(place) * micrometre));
    zone["height_melted"].push_back(heights.first.value());
    zone["height_softened"].push_back(heights.second.value());
  }
  return zone;
}

/// Fields of one tracer result in the cut cells; those of the solids are null above the stock line.
json fields_of(const StageReport& stage, const MidPlane& plane, double stock_line) {
  const FieldFile file(stage.result(), "tracer-result");
  json fields = json::object();
  const auto add = [&](const std::string& name, bool of_solids, const auto& value_of) {
    json values = json::array();
    for (const CutCell& cut : plane.cells) {
      const bool outside = of_solids && cut.centre[1] > stock_line;
      values.push_back(outside ? json(nullptr) : rounded(value_of(cut.cell), digits_drawn));
    }
    fields[name] = std::move(values);
  };
  for (const auto& [name, of_solids] :
       {std::pair{"solids_temperature", true}, {"gas_temperature", false}, {"solids_fraction", true}}) {
    if (file.has_cell_data(name)) {
      const std::vector<double> field = file.cell_data(name);
      add(name, of_solids, [&](std::size_t cell) { return field[cell]; });
    }
  }
  if (file.has_cell_data("solids_velocity")) {
    const std::vector<double> u = file.cell_data("solids_velocity", 3);
    add("solids_speed", true,
        [&](std::size_t cell) { return std::hypot(u[3 * cell], u[3 * cell + 1], u[3 * cell + 2]); });
  }
  return fields;
}

template <class Make>
json for_each_stage(const std::vector<StageReport>& stages, TaskKind kind, Make make) {
  json entries = json::array();
  for (const StageReport& stage : stages) {
    if (stage.kind == kind) {
      entries.push_back(make(stage));
    }
  }
  return entries;
}

}  // namespace

json furnace_drawing(const Campaign& campaign) {
  json drawing = {{"depth", campaign.scene.geometry.depth},
                  {"cell", campaign.scene.mesh.cell},
                  {"stock_line", campaign.charging.stock_line},
                  {"stock_half_width", campaign.half_width(campaign.charging.stock_line)},
                  {"profile", campaign.scene.geometry.profile},
                  {"tuyeres", json::array()},
                  {"raceways", json::array()},
                  {"raceway_void", nullptr},
                  {"species", json::array()},
                  {"guessed_zone", nullptr},
                  {"softening_temperature", nullptr},
                  {"melting_temperature", nullptr}};
  if (campaign.scene.gas) {
    for (const Inlet& inlet : campaign.scene.gas->inlets) {
      if (inlet.side != Inlet::Side::bottom) {
        const double sign = inlet.side == Inlet::Side::left ? -1 : 1;
        drawing["tuyeres"].push_back(
            {{"name", inlet.name}, {"x", sign * campaign.half_width(inlet.z)}, {"z", inlet.z}});
      }
    }
  }
  for (const Raceway& raceway : campaign.raceways) {
    drawing["raceway_void"] = raceway.void_fraction;
    drawing["raceways"].push_back({raceway.box[0][0], raceway.box[1][0], raceway.box[0][2], raceway.box[1][2]});
  }
  for (const Species& species : campaign.species) {
    drawing["species"].push_back(species.name);
    if (species.softening) {
      drawing["softening_temperature"] = species.softening->from;
      drawing["melting_temperature"] = species.softening->melted;
    }
  }
  if (const auto& zone = campaign.initial.cohesive_zone) {
    drawing["guessed_zone"] = {{"tip", zone->tip}, {"slope", zone->slope}};
  }
  return drawing;
}

json dem_history(const std::vector<StageReport>& stages) {
  return for_each_stage(stages, TaskKind::dem, [](const StageReport& stage) {
    std::map<std::string, std::string> pointers{{"time", "/time"},
                                                {"parcels", "/parcels"},
                                                {"stock_height", "/stock_height"},
                                                {"mean_speed", "/mean_speed"},
                                                {"largest_overlap", "/largest_overlap"}};
    if (!stage.history.empty() && stage.history.back().contains("parcels_by_species")) {
      for (const auto& [species, number] : stage.history.back()["parcels_by_species"].items()) {
        pointers["parcels." + species] = "/parcels_by_species/" + species;
      }
    }
    return columns_of(stage, pointers);
  });
}

json tracer_history(const std::vector<StageReport>& stages) {
  return for_each_stage(stages, TaskKind::tracer, [](const StageReport& stage) {
    return columns_of(stage, {{"time", "/time"},
                              {"tracers", "/tracers"},
                              {"mean_solid_temperature", "/mean_solid_temperature"},
                              {"top_gas_temperature", "/top_gas_temperature"},
                              {"cohesive_zone_height", "/cohesive_zone_height"}});
  });
}

json cohesive_zones(const std::vector<StageReport>& stages) {
  json zones = json::array();
  for (const StageReport& stage : stages) {
    if (stage.kind == TaskKind::tracer && stage.readable && HdfReader(stage.result()).has("CohesiveZone/x")) {
      zones.push_back(cohesive_zone(stage));
    }
  }
  return zones;
}

json field_maps(const std::vector<StageReport>& stages, const Campaign& campaign) {
  json maps = {{"episodes", json::array()}};
  MidPlane plane;
  std::string mesh_hash;
  for (const StageReport& stage : stages) {
    if (stage.kind != TaskKind::tracer || !stage.readable) {
      continue;
    }
    if (plane.cells.empty()) {
      const FieldFile file(stage.result(), "tracer-result");
      plane = cut_mid_plane(file.points(), file.cell_points());
      mesh_hash = stage.mesh_hash;
    }
    if (stage.mesh_hash == mesh_hash) {
      maps["episodes"].push_back(
          {{"episode", stage.episode}, {"fields", fields_of(stage, plane, campaign.charging.stock_line)}});
    }
  }
  maps["y"] = rounded(plane.y);
  for (const char* name : {"x", "z", "x_centre", "z_centre"}) {
    maps[name] = json::array();
  }
  for (const CutCell& cut : plane.cells) {
    json x = json::array();
    json z = json::array();
    for (const auto& corner : cut.corners) {
      x.push_back(rounded(corner[0], digits_drawn));
      z.push_back(rounded(corner[1], digits_drawn));
    }
    maps["x"].push_back(std::move(x));
    maps["z"].push_back(std::move(z));
    maps["x_centre"].push_back(rounded(cut.centre[0], digits_drawn));
    maps["z_centre"].push_back(rounded(cut.centre[1], digits_drawn));
  }
  return maps;
}

}  // namespace cupola
