#pragma once
#include <filesystem>
#include <string>

#include "schemas/campaign.hpp"
#include "schemas/task.hpp"

namespace cupola {

/// Mass that a ledger may miss, relative to what it took in: sums over parcels lose digits, and nothing else.
inline constexpr double greatest_mass_residual = 1e-8;
/// Energy that the tracer stage's ledger may miss, relative to the enthalpy of the blast.
inline constexpr double greatest_energy_residual = 5e-3;

/// Looks a finished stage's result over before it is passed on: hashes, kind, campaign, fields finite and within their
/// bounds, numbers of the summary finite, ledgers closed.
/// @throws Failure input_output (damaged), wrong_input (of another campaign), diverged (the numbers are not to be used)
void check_result(const std::filesystem::path& task_folder, TaskKind kind, const Campaign& campaign,
                  const std::string& campaign_hash);

}  // namespace cupola
