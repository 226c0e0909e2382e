# SPDX-License-Identifier: MIT
# Installs a build and moves it somewhere else; there the program renders, and a project finds and uses the library.
# Arguments, as -DNAME=VALUE: BUILD (directory), SCENE (file), COMPILER and its FLAGS.

set(directory "${BUILD}/install_test")
file(REMOVE_RECURSE "${directory}")

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN} gave ${result}:\n${output}")
  endif()
endfunction()

function(check_image file)
  if(NOT EXISTS "${file}")
    message(FATAL_ERROR "there is no ${file}")
  endif()
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${directory}/installed")
file(RENAME "${directory}/installed" "${directory}/moved")

run("${directory}/moved/bin/renderer" "${SCENE}" --size 16x12 --spp 2 --quiet -o "${directory}/program.exr")
check_image("${directory}/program.exr")

run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}" -B "${directory}/consumer" -G Ninja
  "-DCMAKE_PREFIX_PATH=${directory}/moved" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("${CMAKE_COMMAND}" --build "${directory}/consumer")
file(WRITE "${directory}/suite.xml"
  "<suite size='16x12' spp='4'><render scene='${SCENE}' name='same' reference='same.exr'/></suite>\n")
run("${directory}/moved/bin/renderer" batch "${directory}/suite.xml" --update --quiet)
# The package without the library: tests of images.
file(WRITE "${directory}/testing/CMakeLists.txt" "cmake_minimum_required(VERSION 3.22)
project(testing LANGUAGES NONE)
enable_testing()
find_package(plumb COMPONENTS testing REQUIRED)
plumb_add_render_test(NAME suite SUITE ${directory}/suite.xml)
plumb_add_render_test(NAME image IMAGE ${directory}/same.exr REFERENCE ${directory}/same.exr)
")
run("${CMAKE_COMMAND}" -S "${directory}/testing" -B "${directory}/testing/build" -G Ninja
  "-DCMAKE_PREFIX_PATH=${directory}/moved")
run("${CMAKE_CTEST_COMMAND}" --test-dir "${directory}/testing/build" --no-tests=error)
file(MAKE_DIRECTORY "${directory}/out")
run("${directory}/consumer/consumer" "${SCENE}" "${directory}/suite.xml" "${directory}/out")
check_image("${directory}/out/whole.exr")
check_image("${directory}/out/suite/same_4.exr")
check_image("${directory}/out/suite/report.html")
