# SPDX-License-Identifier: MIT
# Installs a build and moves it somewhere else; there the program renders, and a project finds and uses the library.
# Arguments, as -DNAME=VALUE: BUILD (folder), SCENE (file), COMPILER and its FLAGS.

set(folder "${BUILD}/install_test")
file(REMOVE_RECURSE "${folder}")

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN} gave ${result}:\n${output}")
  endif()
endfunction()

function(check_picture file)
  if(NOT EXISTS "${file}")
    message(FATAL_ERROR "there is no ${file}")
  endif()
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${folder}/installed")
file(RENAME "${folder}/installed" "${folder}/moved")

run("${folder}/moved/bin/renderer" "${SCENE}" --size 16x12 --spp 2 --quiet -o "${folder}/program.exr")
check_picture("${folder}/program.exr")

run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}" -B "${folder}/consumer" -G Ninja
  "-DCMAKE_PREFIX_PATH=${folder}/moved" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("${CMAKE_COMMAND}" --build "${folder}/consumer")
run("${folder}/consumer/consumer" "${SCENE}" "${folder}/consumer.exr")
check_picture("${folder}/consumer.exr")
