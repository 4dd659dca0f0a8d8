#pragma once
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/campaign.hpp"
#include "stage_tracer/charge_plan.hpp"
#include "stage_tracer/granular_field.hpp"
#include "stage_tracer/tracers.hpp"

namespace cupola {

/// A tracer that enters through the stock plane.
struct Entry {
  std::int64_t id = 0;
  std::uint8_t species = 0;
  double time = 0;         ///< s, exactly when it passes the face
  PathField::Point point;  ///< on the face
  double volume = 0;       ///< m3
};

/// Charges the bed through the faces of the stock plane.  Each face passes the layers in turn at its own volume rate
/// and keeps, a species, the volume it still owes; a tracer enters at the instant the owed volume has grown to a
/// tracer's.  So the volume charged through a face follows its flux for ever, and times, ids and with them all random
/// numbers of the tracers are the same whatever the steps.  Every rank computes all entries and keeps its own.
class Insertion {
 public:
  /// @param tracer_volume m3 of a tracer of each species
  /// @param first_id of the tracers to come, above all ids in use
  Insertion(const BedMesh& mesh, std::vector<StockFace> faces, const ChargePlan& charge,
            std::vector<double> tracer_volume, std::uint64_t seed, std::int64_t first_id);

  /// All entries of the time interval, sorted by face, then time.
  std::vector<Entry> advance(double from, double to);

  /// For a checkpoint, faces x species: the volume owed, m3, and the tracers that have entered.
  struct State {
    std::vector<double> owed;
    std::vector<std::int64_t> entered;
  };
  [[nodiscard]] const State& state() const { return state_; }
  void restore(State state) { state_ = std::move(state); }

 private:
  Entry enter(std::size_t face, std::size_t species, double time);

  std::vector<StockFace> faces_;
  std::vector<std::size_t> side_;  ///< of each face in its cell: 0-5 in reference order
  const ChargePlan& charge_;
  std::vector<double> tracer_volume_;
  std::uint64_t seed_;
  std::int64_t first_id_;
  State state_;
};

}  // namespace cupola
