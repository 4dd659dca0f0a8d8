# Imported target LIGGGHTS::liggghts, the packaged LIGGGHTS 3.8.0.
find_path(LIGGGHTS_INCLUDE_DIR liggghts/library.h)
find_library(LIGGGHTS_LIBRARY liggghts)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LIGGGHTS REQUIRED_VARS LIGGGHTS_LIBRARY LIGGGHTS_INCLUDE_DIR)
mark_as_advanced(LIGGGHTS_LIBRARY LIGGGHTS_INCLUDE_DIR)
if(LIGGGHTS_FOUND AND NOT TARGET LIGGGHTS::liggghts)
  find_package(MPI REQUIRED COMPONENTS CXX)
  add_library(LIGGGHTS::liggghts SHARED IMPORTED)
  set_target_properties(LIGGGHTS::liggghts PROPERTIES IMPORTED_LOCATION "${LIGGGHTS_LIBRARY}")
  # Its headers include each other both as <liggghts/x.h> and as "x.h" beside them.
  target_include_directories(LIGGGHTS::liggghts SYSTEM INTERFACE "${LIGGGHTS_INCLUDE_DIR}" "${LIGGGHTS_INCLUDE_DIR}/liggghts")
  target_link_libraries(LIGGGHTS::liggghts INTERFACE MPI::MPI_CXX)
endif()
