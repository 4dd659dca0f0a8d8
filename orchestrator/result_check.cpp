#include "orchestrator/result_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schemas/failure.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

using nlohmann::json;

Failure refused(const std::filesystem::path& file, const std::string& what, const std::string& why) {
  return Failure(ExitCode::diverged,
                 fmt::format("{}: {} {}. The result is not passed on; look at stage.log and the history beside it, and "
                             "try a smaller time step.",
                             file.string(), what, why))
      .at("file", file.string())
      .at("quantity", what);
}

/// Bounds a field must keep, wherever it is.
struct Bounds {
  double low, high;
};

Bounds bounds_of(const std::string& name) {
  constexpr double beyond_any_furnace = 1e4;  // K
  constexpr double round_off = 1e-9;
  // A parcel's volume is counted where its division points lie: a cell smaller than a parcel may get more than it
  // holds.
  constexpr double beyond_any_packing = 2;
  if (name.find("temperature") != std::string::npos) return {0., beyond_any_furnace};
  if (name.ends_with("_error")) return {-HUGE_VAL, HUGE_VAL};
  if (name.starts_with("solids_fraction")) return {-round_off, beyond_any_packing};
  if (name.starts_with("volume_share")) return {-round_off, 1. + round_off};
  return {-HUGE_VAL, HUGE_VAL};
}

void check_fields(const FieldFile& result, const std::filesystem::path& file) {
  for (const std::string& name : result.cell_data_names()) {
    const Bounds bounds = bounds_of(name);
    // Vectors are read as what they are: as many columns as fit.
    const std::vector<double> values = result.hdf().doubles("VTKHDF/CellData/" + name);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t columns = std::max<std::size_t>(values.size() / std::max<std::size_t>(result.cells(), 1), 1);
      const std::string where = fmt::format("{} in cell {}", name, i / columns);
      if (!std::isfinite(values[i])) throw refused(file, where, "is not a finite number");
      if (values[i] < bounds.low || values[i] > bounds.high)
        throw refused(file, where, fmt::format("is {}, outside {} to {}", values[i], bounds.low, bounds.high));
    }
  }
}

/// JSON holds what is not finite as null: the height of a zone that is not there, the packing of a bed without inside.
bool may_be_unknown(const std::string& path) {
  return path.find("_zone") != std::string::npos || path.ends_with(".packing_fraction");
}

void check_numbers(const json& value, const std::string& path, const std::filesystem::path& file) {
  if (value.is_null() && !may_be_unknown(path)) throw refused(file, path, "is not a finite number");
  if (!value.is_structured()) return;
  for (const auto& [key, inner] : value.items()) check_numbers(inner, path + "." + key, file);
}

void check_residual(const json& summary, const std::string& pointer, double greatest,
                    const std::filesystem::path& file) {
  const json::json_pointer where(pointer);
  if (!summary.contains(where) || !summary[where].is_number()) throw refused(file, "Summary" + pointer, "is missing");
  const double residual = std::abs(summary[where].get<double>());
  if (residual > greatest)
    throw refused(file, "Summary" + pointer, fmt::format("is {:.3g}, more than {:.3g}", residual, greatest));
}

}  // namespace

void check_result(const std::filesystem::path& task_folder, TaskKind kind, const Campaign& campaign,
                  const std::string& campaign_hash) {
  verify_manifest(task_folder);
  const std::filesystem::path file = task_folder / "result.hdf";
  const FieldFile result(file, kind == TaskKind::dem ? "dem-result" : "tracer-result");
  if (result.header().campaign_hash != campaign_hash)
    throw Failure(ExitCode::wrong_input, fmt::format("{}: the result of another campaign. Nothing was changed. Move "
                                                     "its task folder away and resume.",
                                                     file.string()))
        .at("file", file.string());
  check_fields(result, file);
  const json summary = result.summary();
  check_numbers(summary, "Summary", file);
  if (kind == TaskKind::dem) {
    check_residual(summary, "/ledger/residual", greatest_mass_residual, file);
  } else {
    check_residual(summary, "/ledger/mass/residual", greatest_mass_residual, file);
    // A prediction that did not converge does not close; it is not gone on from either.
    const bool converged =
        kind != TaskKind::predict || summary.value(json::json_pointer("/prediction/converged"), false);
    if (campaign.heat && converged) check_residual(summary, "/ledger/energy/residual", greatest_energy_residual, file);
  }
}

}  // namespace cupola
