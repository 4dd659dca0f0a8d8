#include "stage_dem/dem_gas.hpp"

#include "stage_dem/gas_coupling.hpp"
#include "stage_dem/transient_coupling.hpp"

namespace cupola {

std::unique_ptr<DemGas> make_dem_gas(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign,
                                     const std::vector<double>& temperature, MPI_Comm communicator) {
  if (!campaign.scene.gas || campaign.dem.gas == DemSettings::GasModel::none) return nullptr;
  if (campaign.dem.gas == DemSettings::GasModel::transient)
    return std::make_unique<TransientCoupling>(foam, mesh, campaign, temperature, communicator);
  return std::make_unique<GasCoupling>(foam, mesh, campaign, temperature, communicator);
}

}  // namespace cupola
