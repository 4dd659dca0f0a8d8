cupola_test(
  unit_files
  LABEL unit
  SOURCES unit/files/test_field_file.cpp unit/files/test_folder_lock.cpp unit/files/test_hdf.cpp unit/files/test_history.cpp
          unit/files/test_manifest.cpp unit/files/test_small_files.cpp
  LIBRARIES cupola_schemas)
