# The DEM stage: its engine and its parts on one and on two ranks, the program on a tiny slot.
foreach(part engine parts)
  add_executable(test_dem_${part} unit/dem/test_${part}.cpp unit/dem/box_scene.cpp unit/dem/mpi_main.cpp)
  cupola_own_code(test_dem_${part})
  target_link_libraries(test_dem_${part} PRIVATE cupola_dem GTest::gtest GTest::gmock)
  foreach(ranks 1 2)
    cupola_mpi_test(dem_${part}_${ranks} LABEL verification RANKS ${ranks} PROGRAM test_dem_${part})
  endforeach()
endforeach()
target_link_libraries(test_dem_parts PRIVATE cupola_box_mesh)
target_sources(test_dem_parts PRIVATE unit/dem/test_models.cpp)

cupola_test(dem_stationarity LABEL unit SOURCES unit/dem/stationarity_test.cpp LIBRARIES cupola_dem)

cupola_test(dem_program LABEL workflow SOURCES workflow/dem_program_test.cpp LIBRARIES cupola_schemas)
add_dependencies(dem_program cupola-dem)
target_compile_definitions(dem_program PRIVATE CUPOLA_DEM="$<TARGET_FILE:cupola-dem>" CUPOLA_MPIEXEC="${MPIEXEC_EXECUTABLE}"
                                               CUPOLA_TINY="${CMAKE_SOURCE_DIR}/cases/tiny/campaign.yaml")

# Proofs against exact answers and published figures (docs/verification_dem.md), each a test of its own: with the engine alone.

add_executable(dem_proofs verification/dem/proof_01_collisions.cpp
                          verification/dem/proof_02_rolling.cpp
                          verification/dem/proof_03_packing.cpp
                          verification/dem/proof_04_hopper.cpp
                          verification/dem/proof_09_momentum.cpp
                          verification/dem/proof_11_standard_errors.cpp
                          verification/dem/proof_scene.cpp unit/dem/box_scene.cpp unit/dem/mpi_main.cpp)
cupola_own_code(dem_proofs)
target_link_libraries(dem_proofs PRIVATE cupola_dem GTest::gtest)

function(dem_proof name program filter ranks)
  cupola_mpi_test(dem_proof_${name} LABEL verification RANKS ${ranks} PROGRAM ${program} ARGUMENTS --gtest_filter=${filter})
endfunction()
dem_proof(01_two_parcels dem_proofs Collisions.TwoParcels* 1)
dem_proof(01_wall dem_proofs Collisions.AParcelRebounds* 1)
dem_proof(01_coarse_graining dem_proofs Collisions.RelativeOverlap* 1)
dem_proof(02_rolling dem_proofs Rolling.* 1)
dem_proof(03_packing_of_grains dem_proofs Packing.Grains* 1)
dem_proof(03_packing_of_furnace dem_proofs Packing.TheFurnaces* 1)
dem_proof(03_packing_of_parcels dem_proofs Packing.ParcelsPack* 1)
dem_proof(04_beverloo dem_proofs Hopper.Discharges* 1)
dem_proof(04_angle_of_repose dem_proofs AngleOfRepose.* 1)
dem_proof(09_impulse_1 dem_proofs Impulse.* 1)
dem_proof(09_impulse_2 dem_proofs Impulse.* 2)
dem_proof(11_coverage dem_proofs StandardErrors.* 1)

# With the gas, on the mesh of a box.
add_executable(dem_gas_proofs verification/dem/proof_05_terminal_velocity.cpp
                              verification/dem/proof_06_ergun.cpp
                              verification/dem/proof_07_fluidisation.cpp
                              verification/dem/proof_08_riser.cpp
                              verification/dem/proof_09_gas_momentum.cpp
                              verification/dem/proof_12_turbulence.cpp
                              verification/dem/gas_scene.cpp
                              verification/dem/proof_scene.cpp unit/dem/box_scene.cpp unit/dem/mpi_main.cpp)
cupola_own_code(dem_gas_proofs)
target_link_libraries(dem_gas_proofs PRIVATE cupola_dem_stage cupola_foam_environment GTest::gtest)
dem_proof(05_quasi_steady dem_gas_proofs *TerminalVelocity*/0 1)
dem_proof(05_transient dem_gas_proofs *TerminalVelocity*/1 1)
dem_proof(06_quasi_steady dem_gas_proofs *ErgunBed*/0 1)
dem_proof(06_transient dem_gas_proofs *ErgunBed*/1 1)
dem_proof(06_frozen dem_gas_proofs FrozenGas.* 1)
dem_proof(07_fluidisation dem_gas_proofs Fluidisation.OfParcels* 1)
dem_proof(08_riser dem_gas_proofs Riser.* 1)
dem_proof(09_gas_1 dem_gas_proofs GasMomentum.* 1)
dem_proof(09_gas_2 dem_gas_proofs GasMomentum.Given* 2)
dem_proof(12_turbulence_1 dem_gas_proofs *GridTurbulence*:TurbulenceInABed.* 1)
dem_proof(12_turbulence_2 dem_gas_proofs *GridTurbulence*/0 2)
cupola_mpi_test(dem_proof_07_in_full LABEL long RANKS 1 PROGRAM dem_gas_proofs ARGUMENTS --gtest_filter=FluidisationInFull.*)
set_tests_properties(dem_proof_07_in_full PROPERTIES TIMEOUT 3600)

# The program on the tiny slot, some seconds of it.
cupola_test(dem_proof_10 LABEL long SOURCES verification/dem/proof_10_ranks_test.cpp LIBRARIES cupola_schemas)
add_dependencies(dem_proof_10 cupola-dem)
target_compile_definitions(dem_proof_10 PRIVATE CUPOLA_DEM="$<TARGET_FILE:cupola-dem>" CUPOLA_MPIEXEC="${MPIEXEC_EXECUTABLE}"
                                                CUPOLA_TINY="${CMAKE_SOURCE_DIR}/cases/tiny/campaign.yaml")
