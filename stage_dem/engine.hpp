#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// One parcel: a sphere that stands for coarse_graining^3 grains.
struct Parcel {
  std::int64_t id = 0;         ///< from 1, never used twice in a stage
  int species = 0;             ///< index in the campaign
  Vector3 position{};          ///< m
  Vector3 velocity{};          ///< m/s
  Vector3 angular_velocity{};  ///< rad/s
  double radius = 0;           ///< m, of contact (softened)
  double mass = 0;             ///< kg
  Vector3 displacement{};      ///< m, over the last `advance`; zero for a parcel added since
};

/// Forces of the gas on a parcel over the next block: F = force - damping * velocity.
struct ParcelForce {
  Vector3 force{};     ///< N
  double damping = 0;  ///< N s/m
};

/// A particle engine: moves parcels under contacts, gravity and given forces.  Every rank of its communicator calls
/// every method (all are collective unless said otherwise); a parcel is owned by one rank at a time.
class Engine {
 public:
  virtual ~Engine() = default;

  /// Parcels this rank owns now, in the engine's own order, which stays until the next non-const call.  Not collective.
  [[nodiscard]] virtual std::vector<Parcel> owned() const = 0;

  /// Parcels on all ranks.
  [[nodiscard]] virtual std::int64_t count() const = 0;

  /// One block of `steps` time steps, begun with a full set-up.
  /// @throws Failure diverged: a parcel left the domain or its position is no number (names step and parcel)
  /// @param couple where given, is called before the first step, and again after as many steps as it returned (at least
  /// 1); it may call `owned` and `set_forces`, and the forces it sets act on the steps that follow and on no other:
  /// their impulse is force x time to round-off
  virtual void advance(long steps, const std::function<long()>& couple = {}) = 0;

  /// Steps done since the engine began.
  [[nodiscard]] virtual long step() const = 0;

  /// Forces from the gas, in the order of `owned`; they stay until they are set again.
  virtual void set_forces(const std::vector<ParcelForce>& forces) = 0;

  /// Which parcels stand still from now on, in the order of `owned`: neither forces nor contacts move them; the others
  /// go on (again).
  virtual void hold(const std::vector<bool>& held) = 0;

  /// Sets the time step, s.
  virtual void set_time_step(double seconds) = 0;

  /// Adds parcels; the same list on every rank, each parcel is taken by the rank that owns its position.
  /// @throws Failure diverged where a position lies outside the domain (names the parcel)
  virtual void add(const std::vector<Parcel>& parcels) = 0;

  /// Removes parcels; a rank names some or all of those it owns, and others are ignored. Contacts of the others keep
  /// their history.
  virtual void remove(const std::vector<std::int64_t>& ids) = 0;

  /// Sets the contact radii, in the order of `owned`; masses stay.
  virtual void resize(const std::vector<double>& radii) = 0;

  /// Brings every parcel to the rank that owns its position, and inside the period.  To be done after each block:
  /// `snapshot` does it too, and sums over parcels must not depend on when one was taken.
  virtual void exchange() = 0;

  /// The whole state, on rank 0; empty on the others.  Changes nothing after an `exchange`.
  [[nodiscard]] virtual std::vector<std::uint8_t> snapshot() = 0;
};

/// How to set up an engine, besides the campaign.
struct EngineSetUp {
  std::string wall_file;           ///< triangles of the walls (STL)
  std::string folder;              ///< for logs and temporary files
  double time_step = 0;            ///< s
  std::vector<std::uint8_t> from;  ///< a snapshot to go on from (on rank 0); empty: an empty domain
};

}  // namespace cupola
