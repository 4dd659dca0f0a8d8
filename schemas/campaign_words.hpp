#pragma once
#include <array>
#include <string_view>
#include <utility>

#include "schemas/campaign.hpp"

/// The words that stand for enumerators in campaign files.
namespace cupola::words {

template <typename Enum, std::size_t count>
using Table = std::array<std::pair<Enum, std::string_view>, count>;

inline constexpr Table<Geometry::Sides, 2> sides{
    {{Geometry::Sides::periodic, "periodic"}, {Geometry::Sides::walls, "walls"}}};
inline constexpr Table<Inlet::Side, 3> inlet_side{
    {{Inlet::Side::left, "left"}, {Inlet::Side::right, "right"}, {Inlet::Side::bottom, "bottom"}}};
inline constexpr Table<Contacts::Model, 2> contact_model{
    {{Contacts::Model::hertz, "hertz"}, {Contacts::Model::linear_spring, "linear-spring"}}};
inline constexpr Table<Contacts::Rolling, 4> rolling_model{{{Contacts::Rolling::none, "none"},
                                                            {Contacts::Rolling::cdt, "cdt"},
                                                            {Contacts::Rolling::epsd, "epsd"},
                                                            {Contacts::Rolling::epsd2, "epsd2"}}};
inline constexpr Table<Contacts::StiffnessOf, 2> stiffness_of{
    {{Contacts::StiffnessOf::grain, "grain"}, {Contacts::StiffnessOf::parcel, "parcel"}}};
inline constexpr Table<DragLaw, 7> drag{{{DragLaw::ergun, "ergun"},
                                         {DragLaw::wen_yu, "wen-yu"},
                                         {DragLaw::gidaspow, "gidaspow"},
                                         {DragLaw::di_felice, "di-felice"},
                                         {DragLaw::koch_hill, "koch-hill"},
                                         {DragLaw::beetstra, "beetstra"},
                                         {DragLaw::emms, "emms"}}};
inline constexpr Table<Raceway::Removal, 2> raceway_removal{
    {{Raceway::Removal::rate, "rate"}, {Raceway::Removal::keep_void, "keep-void"}}};
inline constexpr Table<DemSettings::VoidFraction, 2> void_fraction{
    {{DemSettings::VoidFraction::divided, "divided"}, {DemSettings::VoidFraction::smoothed, "smoothed"}}};
inline constexpr Table<DemSettings::GasModel, 4> dem_gas{{{DemSettings::GasModel::none, "none"},
                                                          {DemSettings::GasModel::frozen, "frozen"},
                                                          {DemSettings::GasModel::quasi_steady, "quasi-steady"},
                                                          {DemSettings::GasModel::transient, "transient"}}};
inline constexpr Table<TransientGas::Turbulence, 4> turbulence{
    {{TransientGas::Turbulence::laminar, "laminar"},
     {TransientGas::Turbulence::k_epsilon, "k-epsilon"},
     {TransientGas::Turbulence::rng_k_epsilon, "rng-k-epsilon"},
     {TransientGas::Turbulence::realizable_k_epsilon, "realizable-k-epsilon"}}};
inline constexpr Table<DemSettings::Stop, 2> dem_stop{
    {{DemSettings::Stop::fields_converged, "fields-converged"}, {DemSettings::Stop::duration, "duration"}}};
inline constexpr Table<TracerSettings::Displacement, 4> displacement{
    {{TracerSettings::Displacement::none, "none"},
     {TracerSettings::Displacement::random, "random"},
     {TracerSettings::Displacement::relaxation, "relaxation"},
     {TracerSettings::Displacement::random_and_relaxation, "random-and-relaxation"}}};
inline constexpr Table<TracerSettings::Stop, 2> tracer_stop{
    {{TracerSettings::Stop::duration, "duration"}, {TracerSettings::Stop::steady, "steady"}}};
inline constexpr Table<TracerSettings::Resolve, 2> tracer_resolve{
    {{TracerSettings::Resolve::automatic, "auto"}, {TracerSettings::Resolve::every_step, "every-step"}}};
inline constexpr Table<SlurmLaunch::Starter, 2> slurm_starter{
    {{SlurmLaunch::Starter::mpirun, "mpirun"}, {SlurmLaunch::Starter::srun, "srun"}}};
inline constexpr Table<TracerSettings::GasModel, 3> tracer_gas{
    {{TracerSettings::GasModel::none, "none"},
     {TracerSettings::GasModel::darcy_forchheimer, "darcy-forchheimer"},
     {TracerSettings::GasModel::navier_stokes, "navier-stokes"}}};
inline constexpr Table<Gas::ViscosityModel, 2> viscosity_model{
    {{Gas::ViscosityModel::constant, "constant"}, {Gas::ViscosityModel::sutherland, "sutherland"}}};
inline constexpr Table<Gas::HeatCapacityModel, 2> heat_capacity_model{
    {{Gas::HeatCapacityModel::constant, "constant"}, {Gas::HeatCapacityModel::janaf, "janaf"}}};
inline constexpr Table<WallHeatLoss::On, 3> heat_loss_on{
    {{WallHeatLoss::On::gas, "gas"}, {WallHeatLoss::On::solids, "solids"}, {WallHeatLoss::On::both, "both"}}};
inline constexpr Table<Heat::Convection, 3> convection{{{Heat::Convection::ranz_marshall, "ranz-marshall"},
                                                        {Heat::Convection::gunn, "gunn"},
                                                        {Heat::Convection::wakao, "wakao"}}};
inline constexpr Table<Heat::BedConduction, 3> bed_conduction{
    {{Heat::BedConduction::carson, "carson"},
     {Heat::BedConduction::zehner_bauer_schluender, "zehner-bauer-schluender"},
     {Heat::BedConduction::mixture, "mixture"}}};
inline constexpr Table<Strategy, 2> strategy{
    {{Strategy::march, "march"}, {Strategy::predict_and_verify, "predict-and-verify"}}};

template <typename Enum, std::size_t count>
constexpr std::string_view word_of(const Table<Enum, count>& table, Enum wanted) {
  for (const auto& [value, word] : table) {
    if (value == wanted) return word;
  }
  return {};
}

}  // namespace cupola::words
