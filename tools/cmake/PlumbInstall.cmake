# SPDX-License-Identifier: MIT
# What `cmake --install` and CPack put where. Two components: renderer (the program and what it needs) and dev (the library
# for other projects).

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_directory "${CMAKE_INSTALL_LIBDIR}/cmake/plumb")
configure_package_config_file("${PROJECT_SOURCE_DIR}/tools/cmake/plumbConfig.cmake.in" plumbConfig.cmake
  INSTALL_DESTINATION "${package_directory}")
write_basic_package_version_file(plumbConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(TARGETS plumb EXPORT plumbTargets ARCHIVE COMPONENT dev)
install(TARGETS plumb_images EXPORT plumbTargets LIBRARY DESTINATION "${module_install_directory}" COMPONENT renderer)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT dev)
install(EXPORT plumbTargets NAMESPACE plumb:: DESTINATION "${package_directory}" COMPONENT dev)
# Tests of images with CTest need the program alone.
install(FILES "${PROJECT_BINARY_DIR}/plumbConfig.cmake" "${PROJECT_BINARY_DIR}/plumbConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/tools/cmake/PlumbCrypto.cmake" "${PROJECT_SOURCE_DIR}/tools/cmake/PlumbRenderTest.cmake"
  DESTINATION "${package_directory}" COMPONENT renderer)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
  TYPE DOC COMPONENT renderer)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs/" TYPE DOC COMPONENT renderer)

if(TARGET renderer)
  install(TARGETS renderer RUNTIME COMPONENT renderer)
  # In the Python distribution (pyproject.toml), from where Python's packages are.
  install(TARGETS renderer plumb_images DESTINATION plumb/bin COMPONENT wheel EXCLUDE_FROM_ALL)
  install(FILES "${PROJECT_SOURCE_DIR}/src/python/plumb_renderer.py" DESTINATION . COMPONENT wheel EXCLUDE_FROM_ALL)
  install(PROGRAMS "${PROJECT_SOURCE_DIR}/tools/slurm/render" TYPE BIN RENAME renderer-slurm COMPONENT renderer)
  install(PROGRAMS "${PROJECT_SOURCE_DIR}/tools/install-denoiser" TYPE BIN RENAME renderer-install-denoiser COMPONENT renderer)

  # What the program prints of itself. For another processor it cannot be run here, unless it is emulated.
  if(NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR)
    set(printed_files "")
    # plumb_printed(FILE ARGUMENT...): the file, below share/ of the build, has what `renderer ARGUMENT...` prints.
    function(plumb_printed file)
      set(output "${PROJECT_BINARY_DIR}/share/${file}")
      cmake_path(GET output PARENT_PATH directory)
      file(MAKE_DIRECTORY "${directory}")
      add_custom_command(OUTPUT "${output}" COMMAND renderer ${ARGN} > "${output}" DEPENDS renderer VERBATIM)
      set(printed_files ${printed_files} "${output}" PARENT_SCOPE)
      cmake_path(RELATIVE_PATH directory BASE_DIRECTORY "${PROJECT_BINARY_DIR}/share" OUTPUT_VARIABLE place)
      install(FILES "${output}" DESTINATION "${CMAKE_INSTALL_DATADIR}/${place}" COMPONENT renderer)
    endfunction()

    # A verb is one file below src/cli/verbs.
    file(GLOB verbs CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/src/cli/verbs" "${PROJECT_SOURCE_DIR}/src/cli/verbs/*_verb.cpp")
    foreach(verb IN LISTS verbs)
      string(REPLACE "_verb.cpp" "" verb "${verb}")
      if(verb STREQUAL "render")
        plumb_printed(man/man1/renderer.1 man)
      else()
        plumb_printed(man/man1/renderer-${verb}.1 man ${verb})
      endif()
    endforeach()
    plumb_printed(bash-completion/completions/renderer completion bash)
    plumb_printed(zsh/site-functions/_renderer completion zsh)
    plumb_printed(fish/vendor_completions.d/renderer.fish completion fish)
    plumb_printed(plumb/scene.rng schema rng)
    plumb_printed(plumb/scene.xsd schema xsd)
    add_custom_target(printed_files ALL DEPENDS ${printed_files})
  endif()
endif()

# --- Debian packages: cpack -G DEB in the build directory, or tools/package -----------------------------------------

set(CPACK_PACKAGE_NAME plumb-renderer)
set(CPACK_PACKAGE_VENDOR "Plumb")
set(CPACK_PACKAGE_CONTACT "The authors of Plumb <plumb@localhost>") # Debian's control files need an address
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "path tracer for reference images")
set(CPACK_PACKAGE_DESCRIPTION "Renders reference images with error bars, compares images of any renderer
with them, and runs suites of such tests. Equal settings give equal bits,
whatever the threads, tiles, crops, restarts or machines.")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL renderer dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RENDERER_PACKAGE_NAME plumb-renderer)
set(CPACK_DEBIAN_RENDERER_PACKAGE_RECOMMENDS "python3") # renderer-slurm
set(CPACK_DEBIAN_RENDERER_PACKAGE_SUGGESTS "slurm-client")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libplumb-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "plumb-renderer (= ${PROJECT_VERSION}), libembree-dev, libimath-dev, libtbb-dev, libpugixml-dev, libtinyobjloader-dev, libfmt-dev, libssl-dev, zlib1g-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION "path tracer for reference images: library and headers
For programs that render, compare and test with Plumb as a library.")
include(CPack)
