#include "stage_dem/liggghts_engine.hpp"

#include <fmt/format.h>
#include <liggghts/abstract_mesh.h>
#include <liggghts/atom.h>
#include <liggghts/atom_vec.h>
#include <liggghts/comm.h>
#include <liggghts/domain.h>
#include <liggghts/fix.h>
#include <liggghts/fix_mesh.h>
#include <liggghts/group.h>
#include <liggghts/integrate.h>
#include <liggghts/lammps.h>
#include <liggghts/library.h>
#include <liggghts/modify.h>
#include <liggghts/timer.h>
#include <liggghts/update.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string_view>
#include <unordered_set>

#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "schemas/plain_path.hpp"
#include "stage_dem/liggghts_instance.hpp"
#include "stage_dem/liggghts_script.hpp"
#include "stage_dem/memory_file.hpp"
#include "stage_dem/parcels.hpp"

namespace cupola {
namespace {

class LiggghtsEngine final : public Engine {
 public:
  LiggghtsEngine(const Campaign& campaign, const EngineSetUp& set_up, MPI_Comm communicator)
      : plain_folder_(set_up.folder),
        liggghts_(communicator, (plain_folder_.path() / "liggghts.log").string()),
        depth_(period(campaign)) {
    for (const auto& line : liggghts_opening(campaign, liggghts_.ranks())) liggghts_.command(line);
    int resumed = set_up.from.empty() ? 0 : 1;
    MPI_Bcast(&resumed, 1, MPI_INT, 0, liggghts_.communicator());
    if (resumed != 0) {
      read_restart(set_up.from);
    } else {
      for (const auto& line : liggghts_box(campaign)) liggghts_.command(line);
    }
    const std::filesystem::path wall(set_up.wall_file);
    const PlainPath wall_folder(wall.parent_path());
    const auto wall_file = (wall_folder.path() / wall.filename()).string();
    for (const auto& line : liggghts_physics(campaign, wall_file, set_up.time_step)) liggghts_.command(line);
    wall_file_ = wall;
    if (resumed != 0) make_ready();
  }

  std::vector<Parcel> owned() const override {
    const auto& atom = *liggghts_->atom;
    double** begin = per_parcel_vector("block_begin");
    std::vector<Parcel> parcels(static_cast<std::size_t>(atom.nlocal));
    for (int i = 0; i < atom.nlocal; ++i) {
      Parcel& parcel = parcels[static_cast<std::size_t>(i)];
      parcel.id = atom.tag[i];
      parcel.species = atom.type[i] - 1;
      parcel.radius = atom.radius[i];
      parcel.mass = atom.rmass[i];
      for (std::size_t k = 0; k < 3; ++k) {
        parcel.position[k] = atom.x[i][k];
        parcel.velocity[k] = atom.v[i][k];
        parcel.angular_velocity[k] = atom.omega[i][k];
        parcel.displacement[k] = atom.x[i][k] - begin[i][k];
      }
      if (depth_ > 0) parcel.displacement[1] -= depth_ * std::round(parcel.displacement[1] / depth_);
    }
    return parcels;
  }

  std::int64_t count() const override {
    std::int64_t parcels = liggghts_->atom->nlocal;
    MPI_Allreduce(MPI_IN_PLACE, &parcels, 1, MPI_INT64_T, MPI_SUM, liggghts_.communicator());
    return parcels;
  }

  void advance(long steps, const std::function<long()>& couple) override {
    auto& atom = *liggghts_->atom;
    const std::int64_t expected = count();
    double** begin = per_parcel_vector("block_begin");
    std::vector<std::int64_t> before(static_cast<std::size_t>(atom.nlocal));
    for (int i = 0; i < atom.nlocal; ++i) {
      before[static_cast<std::size_t>(i)] = atom.tag[i];
      for (int k = 0; k < 3; ++k) begin[i][k] = atom.x[i][k];
    }
    run_on(steps, couple);
    check_all_there(expected, before);
  }

  long step() const override { return static_cast<long>(liggghts_->update->ntimestep); }

  void set_forces(const std::vector<ParcelForce>& forces) override {
    double** force = per_parcel_vector("dragforce");
    double* damping = per_parcel_scalar("Ksl");
    // Gas velocity `uf` stays zero: the fix adds dragforce + Ksl (uf - v) at every step.
    for (std::size_t i = 0; i < forces.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) force[i][k] = forces[i].force[k];
      damping[i] = forces[i].damping;
    }
    check_drag(forces);
  }

  void hold(const std::vector<bool>& held) override {
    auto& atom = *liggghts_->atom;
    const int bit = held_bit();
    for (std::size_t i = 0; i < held.size(); ++i) {
      atom.mask[i] = held[i] ? atom.mask[i] | bit : atom.mask[i] & ~bit;
      if (!held[i]) continue;
      for (int k = 0; k < 3; ++k) atom.v[i][k] = atom.omega[i][k] = 0;
    }
  }

  void set_time_step(double seconds) override { liggghts_.command(fmt::format("timestep {:.17g}", seconds)); }

  void add(const std::vector<Parcel>& parcels) override {
    save_contact_history();
    const std::int64_t expected = count() + static_cast<std::int64_t>(parcels.size());
    for (auto parcel : parcels) {
      parcel.position[1] = wrapped(parcel.position[1]);
      if (owns(parcel.position)) create(parcel);
    }
    renumber_map();
    if (liggghts_->atom->natoms != expected) fail_outside(parcels);
    if (!ready_ && expected > 0) make_ready();
  }

  void remove(const std::vector<std::int64_t>& ids) override {
    save_contact_history();
    auto& atom = *liggghts_->atom;
    const std::unordered_set<std::int64_t> gone(ids.begin(), ids.end());
    for (int i = 0; i < atom.nlocal;) {
      if (gone.contains(atom.tag[i])) {
        atom.avec->copy(atom.nlocal - 1, i, 1);
        --atom.nlocal;
      } else {
        ++i;
      }
    }
    renumber_map();
  }

  void resize(const std::vector<double>& radii) override {
    auto& atom = *liggghts_->atom;
    for (std::size_t i = 0; i < radii.size(); ++i) {
      atom.radius[i] = radii[i];
      atom.density[i] = atom.rmass[i] / (4.0 / 3 * std::numbers::pi * std::pow(radii[i], 3));
    }
  }

  void exchange() override {
    if (!ready_) return;
    save_contact_history();
    liggghts_->domain->pbc();
    liggghts_->domain->reset_box();
    liggghts_->comm->setup();
    liggghts_->comm->exchange();
    liggghts_->comm->borders();  // the map from tags to places is lost in between
  }

  std::vector<std::uint8_t> snapshot() override {
    const MemoryFile file;
    liggghts_.command("write_restart " + file.name());
    return liggghts_.rank() == 0 ? file.bytes() : std::vector<std::uint8_t>{};
  }

 private:
  double** per_parcel_vector(const char* name) const {
    return static_cast<double**>(lammps_extract_fix(liggghts_.operator->(), name, 1, 2, 0, 0));
  }

  double* per_parcel_scalar(const char* name) const {
    return static_cast<double*>(lammps_extract_fix(liggghts_.operator->(), name, 1, 1, 0, 0));
  }

  /// Of the parcels' masks, for those that stand still.
  [[nodiscard]] int held_bit() const { return liggghts_->group->bitmask[liggghts_->group->find("held")]; }

  /// A run with a full set-up that goes on as if there had been none.  The set-up evaluates the contacts a second time
  /// at the same positions, but with the velocities after the step instead of those in its middle and without adding to
  /// the tangential springs.  A spring at Coulomb's bound may then look as if it were below it, and its dashpot, which
  /// LIGGGHTS does not limit, acts with the whole slip.  So the first half of the first step uses what the contacts
  /// gave in the last step before; the set-up's own values stay for parcels that were not there.
  void run_on(long steps, const std::function<long()>& couple) {
    auto& update = *liggghts_->update;
    update.whichflag = 1;
    update.nsteps = static_cast<int>(steps);
    update.firststep = update.beginstep = update.ntimestep;
    update.laststep = update.endstep = update.ntimestep + steps;
    LiggghtsInstance::guarded("run " + std::to_string(steps), [&] {
      liggghts_->init();
      update.integrate->setup();
      restore_contact_forces();
      liggghts_->timer->init();
      for (long left = steps; left > 0;) {
        const long now = couple ? std::clamp(with_new_forces(couple), 1L, left) : left;
        update.integrate->run(static_cast<int>(now));
        left -= now;
      }
      keep_contact_forces();
      update.integrate->cleanup();
    });
    update.whichflag = 0;
    update.firststep = update.laststep = update.beginstep = update.endstep = 0;
  }

  /// Calls what sets new forces of the gas, and exchanges the old ones for them in what the next step begins with.
  long with_new_forces(const std::function<long()>& couple) {
    const auto& atom = *liggghts_->atom;
    const int held = held_bit();
    double** force = per_parcel_vector("dragforce");
    const auto exchange = [&](double sign) {
      for (int i = 0; i < atom.nlocal; ++i) {
        if ((atom.mask[i] & held) != 0) continue;
        for (int k = 0; k < 3; ++k) atom.f[i][k] += sign * force[i][k];
      }
    };
    exchange(-1);
    const long steps = couple();
    exchange(1);
    return steps;
  }

  /// Of the last evaluation, parcels and walls, before gravity and gas: N, parcels x 3.
  double** contact_force() const {
    const int place = liggghts_->modify->find_fix("contact_force");
    return liggghts_->modify->fix[place]->array_atom;
  }

  void keep_contact_forces() {
    const auto& atom = *liggghts_->atom;
    double** kept = per_parcel_vector("last_contact");
    double** force = contact_force();
    for (int i = 0; i < atom.nlocal; ++i) {
      for (int k = 0; k < 3; ++k) {
        kept[i][k] = force[i][k];
        kept[i][3 + k] = atom.torque[i][k];
      }
      kept[i][6] = 1;
    }
  }

  void restore_contact_forces() {
    auto& atom = *liggghts_->atom;
    const int held = held_bit();
    double** kept = per_parcel_vector("last_contact");
    double** force = contact_force();
    for (int i = 0; i < atom.nlocal; ++i) {
      if (kept[i][6] == 0 || (atom.mask[i] & held) != 0) continue;
      for (int k = 0; k < 3; ++k) {
        atom.f[i][k] += kept[i][k] - force[i][k];
        atom.torque[i][k] = kept[i][3 + k];
      }
    }
  }

  void read_restart(const std::vector<std::uint8_t>& bytes) {
    const MemoryFile file(bytes);
    liggghts_.command("read_restart " + file.name());
  }

  /// LIGGGHTS takes a file that it cannot read to its end for a shorter one: a bed without some of its walls.
  void check_walls() const {
    const std::string text = read_text(wall_file_);
    const std::string_view mark = "endfacet";
    int expected = 0;
    for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + mark.size())) ++expected;
    auto& modify = *liggghts_->modify;
    auto* walls = dynamic_cast<LAMMPS_NS::FixMesh*>(modify.fix[modify.find_fix("wall_mesh")]);
    const int found = walls == nullptr ? 0 : walls->mesh()->sizeGlobal();
    if (found == expected) return;
    throw Failure(
        ExitCode::input_output,
        fmt::format("{}: LIGGGHTS read {} of its {} triangles: the disk failed, or the file is damaged; run again",
                    wall_file_.string(), found, expected))
        .at("file", wall_file_.string());
  }

  /// The first run sets per-parcel properties to their defaults, or to what the restart file holds: an empty one before
  /// anything is written to them.
  void make_ready() {
    const bool restored = liggghts_->update->ntimestep > 0;
    liggghts_.command("run 0 post no");
    check_walls();
    ready_ = true;
    if (restored) return;
    const auto& atom = *liggghts_->atom;
    double** begin = per_parcel_vector("block_begin");
    for (int i = 0; i < atom.nlocal; ++i)
      for (int k = 0; k < 3; ++k) begin[i][k] = atom.x[i][k];
  }

  /// The drag is explicit in the velocity: a parcel that the gas takes along within a step would overtake it, and
  /// within half a step run away.
  void check_drag(const std::vector<ParcelForce>& forces) const {
    const double step = liggghts_->update->dt;
    struct {
      double steps = 0;  ///< time step over the drag's relaxation time
      int parcel = 0;
    } worst;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const double steps = forces[i].damping * step / liggghts_->atom->rmass[i];
      if (steps > worst.steps) worst = {steps, static_cast<int>(liggghts_->atom->tag[i])};
    }
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, liggghts_->world);
    if (worst.steps <= 1) return;
    throw Failure(ExitCode::diverged,
                  fmt::format("the gas takes parcel {} along within {:.3g} s, less than the time step of {:.3g} s: the "
                              "step cannot follow it; take a shorter dem.time_step, or less gas",
                              worst.parcel, step / worst.steps, step))
        .at("parcel", std::to_string(worst.parcel))
        .advise("dem.time_step", fmt::format("{:.3g} s", 0.5 * step / worst.steps));
  }

  /// Contact histories live in the neighbour lists while LIGGGHTS runs; before parcels change places they are moved to
  /// the parcels (once: the fix knows whether a run has happened since).
  void save_contact_history() {
    if (liggghts_->modify->n_fixes_style_strict("contacthistory") == 0) return;
    liggghts_->modify->find_fix_style_strict("contacthistory", 0)->setup_pre_exchange();
  }

  bool owns(const Vector3& position) const {
    const auto& domain = *liggghts_->domain;
    for (std::size_t k = 0; k < 3; ++k)
      if (position[k] < domain.sublo[k] || position[k] >= domain.subhi[k]) return false;
    return true;
  }

  void create(const Parcel& parcel) {
    auto& atom = *liggghts_->atom;
    std::array<double, 3> position = parcel.position;
    atom.avec->create_atom(liggghts_type(static_cast<std::size_t>(parcel.species)), position.data());
    const int i = atom.nlocal - 1;
    atom.tag[i] = static_cast<int>(parcel.id);
    atom.radius[i] = parcel.radius;
    atom.rmass[i] = parcel.mass;
    atom.density[i] = parcel.mass / (4.0 / 3 * std::numbers::pi * std::pow(parcel.radius, 3));
    for (std::size_t k = 0; k < 3; ++k) {
      atom.v[i][k] = parcel.velocity[k];
      atom.omega[i][k] = parcel.angular_velocity[k];
    }
    auto& modify = *liggghts_->modify;
    for (int fix = 0; fix < modify.nfix; ++fix)
      if (modify.fix[fix]->create_attribute != 0) modify.fix[fix]->set_arrays(i);
    double** begin = per_parcel_vector("block_begin");
    for (std::size_t k = 0; k < 3; ++k) begin[i][k] = parcel.position[k] - parcel.displacement[k];
  }

  /// The number of parcels and the map from tags to places, after parcels came or went.
  void renumber_map() {
    auto& atom = *liggghts_->atom;
    atom.natoms = count();
    atom.nghost = 0;
    // The map is sized by the largest tag: it must be known to all.
    atom.map_init();
    atom.map_set();
  }

  void check_all_there(std::int64_t expected, const std::vector<std::int64_t>& before) {
    const auto& atom = *liggghts_->atom;
    std::int64_t lost = 0;
    if (count() != expected) {
      lost = find_lost(before);
    } else {
      std::int64_t bad = 0;
      for (int i = 0; i < atom.nlocal; ++i)
        for (int k = 0; k < 3; ++k)
          if (!std::isfinite(atom.x[i][k]) || !std::isfinite(atom.v[i][k])) bad = atom.tag[i];
      MPI_Allreduce(&bad, &lost, 1, MPI_INT64_T, MPI_MAX, liggghts_.communicator());
    }
    if (lost == 0) return;
    throw Failure(
        ExitCode::diverged,
        fmt::format("parcel {} left the domain or has no finite position at step {}: the time step is too long", lost,
                    step()))
        .at("step", std::to_string(step()))
        .at("parcel", std::to_string(lost))
        .advise("dem.time_step", fmt::format("{:.3g} s", liggghts_->update->dt / 2));
  }

  /// y inside the period: LIGGGHTS wraps only when it rebuilds its neighbour lists, so that a packing's y may lie just
  /// beyond.
  [[nodiscard]] double wrapped(double y) const {
    if (depth_ == 0) return y;
    const double inside = y - depth_ * std::floor(y / depth_ + 0.5);
    return inside < depth_ / 2 ? inside : -depth_ / 2;
  }

  /// The least id that was there before and is nowhere now.
  std::int64_t find_lost(const std::vector<std::int64_t>& before) {
    const auto& atom = *liggghts_->atom;
    std::int64_t largest = 0;
    for (const auto id : before) largest = std::max(largest, id);
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT64_T, MPI_MAX, liggghts_.communicator());
    std::vector<int> balance(static_cast<std::size_t>(largest) + 1, 0);
    for (const auto id : before) ++balance[static_cast<std::size_t>(id)];
    for (int i = 0; i < atom.nlocal; ++i) --balance[static_cast<std::size_t>(atom.tag[i])];
    MPI_Allreduce(MPI_IN_PLACE, balance.data(), static_cast<int>(balance.size()), MPI_INT, MPI_SUM,
                  liggghts_.communicator());
    const auto found = std::find(balance.begin(), balance.end(), 1);
    return found == balance.end() ? 0 : found - balance.begin();
  }

  [[noreturn]] void fail_outside(const std::vector<Parcel>& parcels) const {
    const auto& domain = *liggghts_->domain;
    for (const auto& parcel : parcels)
      for (std::size_t k = 0; k < 3; ++k)
        if (parcel.position[k] < domain.boxlo[k] || parcel.position[k] >= domain.boxhi[k])
          throw Failure(ExitCode::diverged,
                        fmt::format("parcel {} was added outside the domain, at {:.3f} {:.3f} {:.3f} m", parcel.id,
                                    parcel.position[0], parcel.position[1], parcel.position[2]))
              .at("parcel", std::to_string(parcel.id));
    throw Failure(ExitCode::diverged, "parcels were lost while others were added");
  }

  PlainPath plain_folder_;
  LiggghtsInstance liggghts_;
  std::filesystem::path wall_file_;
  double depth_;        ///< m, period along y; 0 with walls
  bool ready_ = false;  ///< whether a first run has been made
};

}  // namespace

std::unique_ptr<Engine> make_liggghts_engine(const Campaign& campaign, const EngineSetUp& set_up,
                                             MPI_Comm communicator) {
  return std::make_unique<LiggghtsEngine>(campaign, set_up, communicator);
}

}  // namespace cupola
