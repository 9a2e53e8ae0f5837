# The package: what `cmake --install` lays down, and what find_package(Waymark) and pkg-config find.
#
#   <prefix>/include/waymark/runtime/*.h     the runtime, headers only: #include <waymark/runtime/mind.h>
#   <prefix>/include/waymark/controllers/*.h the controllers, headers only: <waymark/controllers/any_controller.h>
#   <prefix>/include/waymark/fleet/*.h       many robots at once, headers only: what `kbc compile --fleet` includes
#   <prefix>/bin/kbc                         the compiler
#   <prefix>/bin/kbc-fleet-mpi               its ranks in an MPI job, if it was built with MPI
#   <prefix>/share/waymark/stdlib_rules/     the standard library in the language itself
#   <prefix>/lib/cmake/Waymark/              find_package(Waymark): Waymark::runtime, Waymark::controllers, Waymark::fleet, Waymark::kbc, kb_add_library()
#   <prefix>/lib/pkgconfig/waymark.pc
#   completion for bash, fish, zsh; man pages   printed by kbc itself, so they cannot disagree with it
#
# `cpack -G DEB` in the build's folder makes of it waymark_0.1.0_amd64.deb, and waymark-mpi_... of the ranks, which need MPI.
include(CMakePackageConfigHelpers)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME waymark)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Waymark)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/runtime ${PROJECT_SOURCE_DIR}/controllers ${PROJECT_SOURCE_DIR}/fleet
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/waymark
  FILES_MATCHING PATTERN "*.h")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/stdlib_rules DESTINATION ${CMAKE_INSTALL_DATADIR}/waymark)
set_target_properties(waymark_runtime PROPERTIES EXPORT_NAME runtime)
set_target_properties(waymark_controllers PROPERTIES EXPORT_NAME controllers)
set_target_properties(waymark_fleet PROPERTIES EXPORT_NAME fleet)
install(TARGETS waymark_runtime waymark_controllers waymark_fleet EXPORT WaymarkTargets)

if(TARGET kbc)
  install(TARGETS kbc EXPORT WaymarkTargets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  if(TARGET kbc-fleet-mpi)
    install(TARGETS kbc-fleet-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
  endif()
  set(pages ${PROJECT_BINARY_DIR}/pages)
  add_custom_command(
    OUTPUT ${pages}/kbc.bash ${pages}/kbc.fish ${pages}/kbc.zsh ${pages}/man/kbc.1
    COMMAND ${CMAKE_COMMAND} -E make_directory ${pages}/man
    COMMAND kbc completion bash > ${pages}/kbc.bash
    COMMAND kbc completion fish > ${pages}/kbc.fish
    COMMAND kbc completion zsh > ${pages}/kbc.zsh
    COMMAND kbc man --out ${pages}/man
    DEPENDS kbc
    COMMENT "Writing the man pages and the completion of kbc"
    VERBATIM)
  add_custom_target(waymark_pages ALL DEPENDS ${pages}/kbc.bash ${pages}/man/kbc.1)
  install(FILES ${pages}/kbc.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME kbc)
  install(FILES ${pages}/kbc.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  install(FILES ${pages}/kbc.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _kbc)
  install(DIRECTORY ${pages}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 FILES_MATCHING PATTERN "*.1")
endif()

install(EXPORT WaymarkTargets NAMESPACE Waymark:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/WaymarkConfig.cmake.in ${PROJECT_BINARY_DIR}/WaymarkConfig.cmake
  INSTALL_DESTINATION ${package_dir} PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
# Before 1.0 a minor version may change what generated code looks like.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/WaymarkConfigVersion.cmake COMPATIBILITY SameMinorVersion
  ARCH_INDEPENDENT)   # headers and a compiler: cross-compiling projects find it as well
install(FILES
  ${PROJECT_BINARY_DIR}/WaymarkConfig.cmake
  ${PROJECT_BINARY_DIR}/WaymarkConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/KbAddLibrary.cmake
  ${PROJECT_SOURCE_DIR}/cmake/arm-none-eabi.cmake
  DESTINATION ${package_dir})

# The way up from its folder, which may lie deeper than lib/pkgconfig: Debian's is lib/<machine>/pkgconfig.
file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" up ${up})
configure_file(${PROJECT_SOURCE_DIR}/cmake/waymark.pc.in ${PROJECT_BINARY_DIR}/waymark.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/waymark.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
# The licence by Debian's name; the changelog says what an upgrade takes.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/waymark RENAME copyright)
install(FILES ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/waymark)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Waymark's maintainers <maintainers@waymark.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL waymark)
if(TARGET kbc-fleet-mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
set(CPACK_COMPONENT_MPI_DEPENDS waymark)
set(CPACK_COMPONENT_WAYMARK_DESCRIPTION "kbc, its standard library, and the headers of the runtime, of controllers and fleets.")
set(CPACK_COMPONENT_MPI_DESCRIPTION "Ranks of \`kbc fleet\` for jobs of MPI.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_WAYMARK_PACKAGE_NAME waymark)
set(CPACK_DEBIAN_WAYMARK_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_WAYMARK_PACKAGE_RECOMMENDS "g++, cmake")
set(CPACK_DEBIAN_MPI_PACKAGE_NAME waymark-mpi)
set(CPACK_DEBIAN_MPI_PACKAGE_SECTION devel)
# Folders of a package are for all users, whatever umask it is made with: dpkg lays them down as they are.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/open_folders.cmake @ONLY CONTENT [[
file(GLOB_RECURSE folders LIST_DIRECTORIES true "${CPACK_TEMPORARY_DIRECTORY}/*")
foreach(folder ${folders})
  if(IS_DIRECTORY "${folder}")
    file(CHMOD "${folder}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  endif()
endforeach()
]])
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_BINARY_DIR}/open_folders.cmake)
include(CPack)
