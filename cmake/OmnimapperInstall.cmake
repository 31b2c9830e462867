# cmake --install, and the package that find_package(omnimapper) reads.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/omnimapper")
configure_package_config_file("${CMAKE_CURRENT_SOURCE_DIR}/cmake/omnimapperConfig.cmake.in"
  "${CMAKE_CURRENT_BINARY_DIR}/omnimapperConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/omnimapperConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/omnimapperConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/omnimapperConfigVersion.cmake" DESTINATION "${package_dir}")
install(EXPORT omnimapperTargets NAMESPACE omnimapper:: DESTINATION "${package_dir}")
install(DIRECTORY ini/ DESTINATION "${CMAKE_INSTALL_DATADIR}/omnimapper/ini" FILES_MATCHING PATTERN "*.ini")
install(DIRECTORY web/ DESTINATION "${CMAKE_INSTALL_DATADIR}/omnimapper/web")
# The simulator's INIs, and the pages that programs, INIs and README speak of, with the same paths between them.
file(GLOB places CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/rawlogs/*.ini")
install(FILES ${places} DESTINATION "${CMAKE_INSTALL_DATADIR}/omnimapper/rawlogs")
install(DIRECTORY rawlogs/box rawlogs/home_30s DESTINATION "${CMAKE_INSTALL_DATADIR}/omnimapper/rawlogs")
install(FILES README.md LICENSE CHANGELOG.md CONTRIBUTING.md DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/omnimapper")
install(DIRECTORY doc DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/omnimapper")
foreach(folder ini rawlogs)
  file(GLOB pages CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.md")
  install(FILES ${pages} DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/omnimapper/${folder}")
endforeach()
