# SPDX-License-Identifier: MIT
# Finds OpenImageIO by its headers and libraries. Its own package file is of no use on Debian 12 and Ubuntu 24.04:
# it stops when the command-line tools, which are in a package of their own, are not installed.
#
# Defines OpenImageIO::OpenImageIO and OpenImageIO_VERSION.

find_path(OpenImageIO_INCLUDE_DIR OpenImageIO/oiioversion.h)
find_library(OpenImageIO_LIBRARY OpenImageIO)
find_library(OpenImageIO_Util_LIBRARY OpenImageIO_Util)
mark_as_advanced(OpenImageIO_INCLUDE_DIR OpenImageIO_LIBRARY OpenImageIO_Util_LIBRARY)

set(OpenImageIO_VERSION "")
if(OpenImageIO_INCLUDE_DIR)
  foreach(part IN ITEMS MAJOR MINOR PATCH)
    file(STRINGS "${OpenImageIO_INCLUDE_DIR}/OpenImageIO/oiioversion.h" line
      REGEX "^#[ \t]*define[ \t]+OIIO_VERSION_${part}[ \t]+[0-9]+" LIMIT_COUNT 1)
    string(REGEX MATCH "[0-9]+" number "${line}")
    list(APPEND OpenImageIO_VERSION "${number}")
  endforeach()
  list(JOIN OpenImageIO_VERSION "." OpenImageIO_VERSION)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenImageIO
  REQUIRED_VARS OpenImageIO_LIBRARY OpenImageIO_Util_LIBRARY OpenImageIO_INCLUDE_DIR
  VERSION_VAR OpenImageIO_VERSION)

if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
  add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
    IMPORTED_LOCATION "${OpenImageIO_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${OpenImageIO_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${OpenImageIO_Util_LIBRARY};Imath::Imath")
endif()
