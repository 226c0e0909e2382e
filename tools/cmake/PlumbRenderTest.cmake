# SPDX-License-Identifier: MIT
# Tests of any renderer's images, for CTest. find_package(plumb COMPONENTS testing) has it.
#
#     plumb_add_render_test(NAME box REFERENCE refs/box.exr IMAGE ${CMAKE_CURRENT_BINARY_DIR}/box.exr
#                           COMMAND my_renderer box.xml -o ${CMAKE_CURRENT_BINARY_DIR}/box.exr)
#     plumb_add_render_test(NAME images SUITE suite.xml ALLOW_COMMANDS)
#
# NAME         of the test
# SUITE        a suite, for `renderer batch`; its reports are in ${CMAKE_CURRENT_BINARY_DIR}/NAME
#     ALLOW_COMMANDS   run the commands in it
#     FILTER           only the images whose names contain this
# or
# IMAGE        one image, or several with other seeds
# REFERENCE    what it must equal but for the noise
#     COMMAND  makes the images before; without it they are there
# and
# OPTIONS      more options of `renderer batch` or `renderer compare`
# TIMEOUT      seconds, of each test
#
# Relative files are seen from ${CMAKE_CURRENT_SOURCE_DIR}. An undecided comparison is skipped: it is no agreement.

include_guard(GLOBAL)

get_filename_component(plumb_prefix "${CMAKE_CURRENT_LIST_DIR}" ABSOLUTE)
foreach(step RANGE 2) # lib/cmake/plumb, or with one directory more
  get_filename_component(plumb_prefix "${plumb_prefix}" DIRECTORY)
endforeach()
get_filename_component(plumb_prefix_above "${plumb_prefix}" DIRECTORY)
find_program(PLUMB_RENDERER NAMES renderer HINTS "${plumb_prefix}/bin" "${plumb_prefix_above}/bin"
  DOC "Plumb's program renderer")

function(plumb_add_render_test)
  cmake_parse_arguments(PARSE_ARGV 0 test "ALLOW_COMMANDS" "NAME;SUITE;FILTER;REFERENCE;TIMEOUT" "IMAGE;COMMAND;OPTIONS")
  if(test_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "plumb_add_render_test: unexpected argument '${test_UNPARSED_ARGUMENTS}'")
  endif()
  if(NOT test_NAME)
    message(FATAL_ERROR "plumb_add_render_test needs NAME")
  endif()
  if(test_SUITE AND (test_IMAGE OR test_REFERENCE OR test_COMMAND))
    message(FATAL_ERROR "plumb_add_render_test(${test_NAME}): SUITE goes without IMAGE, REFERENCE and COMMAND")
  endif()
  if(NOT test_SUITE AND NOT (test_IMAGE AND test_REFERENCE))
    message(FATAL_ERROR "plumb_add_render_test(${test_NAME}) needs SUITE, or IMAGE and REFERENCE")
  endif()
  if(NOT PLUMB_RENDERER)
    message(FATAL_ERROR "plumb_add_render_test: cannot find Plumb's program; set PLUMB_RENDERER")
  endif()

  if(test_SUITE)
    set(command "${PLUMB_RENDERER}" batch "${test_SUITE}" --out "${CMAKE_CURRENT_BINARY_DIR}/${test_NAME}")
    if(test_ALLOW_COMMANDS)
      list(APPEND command --allow-commands)
    endif()
    if(test_FILTER)
      list(APPEND command --filter "${test_FILTER}")
    endif()
  else()
    set(command "${PLUMB_RENDERER}" compare ${test_IMAGE} --against "${test_REFERENCE}"
      --diff "${CMAKE_CURRENT_BINARY_DIR}/${test_NAME}_diff.png")
  endif()
  add_test(NAME "${test_NAME}" COMMAND ${command} ${test_OPTIONS} WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}")
  set_tests_properties("${test_NAME}" PROPERTIES SKIP_RETURN_CODE 4)
  set(names "${test_NAME}")
  if(test_COMMAND)
    add_test(NAME "${test_NAME}.render" COMMAND ${test_COMMAND} WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}")
    set_tests_properties("${test_NAME}.render" PROPERTIES FIXTURES_SETUP "${test_NAME}.image")
    set_tests_properties("${test_NAME}" PROPERTIES FIXTURES_REQUIRED "${test_NAME}.image")
    list(APPEND names "${test_NAME}.render")
  endif()
  if(test_TIMEOUT)
    set_tests_properties(${names} PROPERTIES TIMEOUT "${test_TIMEOUT}")
  endif()
endfunction()
