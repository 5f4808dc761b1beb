# What `cmake --install` and packages hold: the program and its page, the laws of a point as a library, the studies' Python.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS vitrum)

# The layers above these depend on SUNDIALS as this build found it, and their interfaces follow the program's needs.
add_library(vitrum::materials ALIAS vitrum_materials)
set_target_properties(vitrum_materials PROPERTIES EXPORT_NAME materials)
set_target_properties(vitrum_tensor PROPERTIES EXPORT_NAME tensor)
install(TARGETS vitrum_tensor vitrum_materials EXPORT vitrumTargets INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/vitrum")
install(DIRECTORY materials src/tensor src/schema DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/vitrum" FILES_MATCHING PATTERN "*.hpp")
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/vitrum")
install(EXPORT vitrumTargets NAMESPACE vitrum:: DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/vitrumConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES cmake/vitrumConfig.cmake "${PROJECT_BINARY_DIR}/vitrumConfigVersion.cmake" DESTINATION "${package_folder}")

# The pages say what --help says; so they are made from it, where all targets are built and help2man is there.
find_program(HELP2MAN help2man)
if(HELP2MAN)
  set(pages "${PROJECT_BINARY_DIR}/man1")
  add_custom_command(OUTPUT "${pages}/vitrum.1" DEPENDS vitrum cmake/ManualPages.cmake
    COMMAND "${CMAKE_COMMAND}" -DPROGRAM=$<TARGET_FILE:vitrum> "-DHELP2MAN=${HELP2MAN}" -DVERSION=${PROJECT_VERSION} "-DFOLDER=${pages}"
            -P "${PROJECT_SOURCE_DIR}/cmake/ManualPages.cmake"
    COMMENT "Writing the manual pages" VERBATIM)
  add_custom_target(vitrum_manual_pages ALL DEPENDS "${pages}/vitrum.1")
  install(DIRECTORY "${pages}" DESTINATION "${CMAKE_INSTALL_MANDIR}" OPTIONAL)
else()
  message(STATUS "help2man not found: no manual pages")
endif()

install(FILES README.md CITATION.cff LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}" FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg" PATTERN "*.gif" PATTERN "*.ipynb")
install(DIRECTORY examples DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(PROGRAMS studies/vitrum-report studies/vitrum-study TYPE BIN)
install(DIRECTORY studies DESTINATION "${CMAKE_INSTALL_DATADIR}/vitrum" USE_SOURCE_PERMISSIONS PATTERN "__pycache__" EXCLUDE)
# `import vitrum`: a Debian package has it where Python looks; other prefixes name the folder in PYTHONPATH. One copy: a link to that of the studies.
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/python")
file(CREATE_LINK "../../../${CMAKE_INSTALL_DATADIR}/vitrum/studies/vitrum" "${PROJECT_BINARY_DIR}/python/vitrum" SYMBOLIC)
install(FILES "${PROJECT_BINARY_DIR}/python/vitrum" DESTINATION lib/python3/dist-packages)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The vitrum developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-numpy, python3-h5py, python3-matplotlib, python3-jinja2")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "snakemake, python3-scipy, python3-pandas")
include(CPack)
