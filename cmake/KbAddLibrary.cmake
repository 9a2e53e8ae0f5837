# Whatever version of CMake a project asks for: names in a depfile are those of the build tree. Else ninja takes the outputs of a
# folder below the top for always out of date. A function has the policies of the place that defines it.
cmake_policy(PUSH)
cmake_policy(SET CMP0116 NEW)

# A file that changes with the bytes of an installed kbc, as they are when CMake runs. Packages keep the time of their making, so by
# times nothing would be compiled again after an upgrade. Empty where kbc is built in this tree.
function(kb_stamp_of_kbc out_var)
  get_property(stamp GLOBAL PROPERTY kb_stamp)   # one for all knowledge bases
  get_target_property(imported Waymark::kbc IMPORTED)
  if(imported AND NOT stamp)
    get_target_property(program Waymark::kbc LOCATION)
    if(EXISTS "${program}")
      set(stamp ${CMAKE_BINARY_DIR}/Waymark/kbc.stamp)
      file(SHA256 "${program}" bytes)
      file(GENERATE OUTPUT ${stamp} CONTENT "${bytes}\n")
      set_property(GLOBAL PROPERTY kb_stamp ${stamp})
    endif()
  endif()
  set(${out_var} ${stamp} PARENT_SCOPE)
endfunction()

# What both functions below make of `name`, `file` and their arguments: source, stem, options, stamp, and the folder `out`.
macro(kb_read_arguments caller)
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${caller}: what is `${arg_UNPARSED_ARGUMENTS}`?")
  endif()
  if(NOT TARGET Waymark::kbc)
    message(FATAL_ERROR "${caller}: there is no kbc; set WAYMARK_KBC to one that runs on this machine")
  endif()
  get_filename_component(source ${file} ABSOLUTE)
  get_filename_component(stem ${file} NAME_WLE)
  set(options ${arg_OPTIONS})
  foreach(ours --namespace --emit --output -o --out --out-dir --depfile --fleet --profile --map)   # what CMake has to know as well
    if("${ours}" IN_LIST options)
      message(FATAL_ERROR "${caller}: OPTIONS cannot take ${ours}; NAMESPACE, FLEET, PROFILE, MAP and kb_add_image do")
    endif()
  endforeach()
  if(arg_LIBRARY)
    get_filename_component(library ${arg_LIBRARY} ABSOLUTE)
    list(APPEND options --library ${library})
  endif()
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${name}.kb)
  if((EXISTS ${out} AND NOT IS_DIRECTORY ${out}) OR source STREQUAL out)
    message(FATAL_ERROR "${caller}: ${out} is to be a folder, and is a file: build in a folder of its own (cmake -B build), or give the target another name")
  endif()
  file(MAKE_DIRECTORY ${out})
  kb_stamp_of_kbc(stamp)
endmacro()

# kb_add_library(NAME FILE.kb [NAMESPACE ns] [LIBRARY folder] [FLEET [PROFILE recording...]] [MAP] [OPTIONS option...])
#
# A static library NAME from a knowledge base: FILE.kb is compiled to FILE.kb.h and FILE.kb.cc, which a program includes as
#   #include "FILE.kb.h"
# (or "NAME.kb/FILE.kb.h", where it has several of one name) and uses as `ns::Mind`; ns may be a::b, and is by default the stem of
# FILE. No two of one program have the same. The library is made again when FILE.kb or any file
# that it imports has changed, also indirectly. FLEET adds FILE.kb.fleet.h and FILE.kb.fleet.cc, for many robots at once
# (docs/fleets.md), and PROFILE names recordings of usual missions, CSV, for which it becomes faster; MAP adds FILE.kb.map.h, the roads
# of its routes for Waymark::controllers (docs/controllers.md). LIBRARY is another folder for `std.*`; OPTIONS go to `kbc compile` as
# they are, as in OPTIONS -Werror. Whoever links NAME into a shared library sets
# POSITION_INDEPENDENT_CODE on it.
#
# Works in Waymark's own tree, in a project that has it as a subdirectory, and in one that has called find_package(Waymark).
function(kb_add_library name file)
  cmake_parse_arguments(PARSE_ARGV 2 arg "FLEET;MAP" "NAMESPACE;LIBRARY" "PROFILE;OPTIONS")
  kb_read_arguments(kb_add_library)
  set(header ${out}/${stem}.kb.h)
  set(code ${out}/${stem}.kb.cc)
  set(made ${header} ${code})
  if(arg_FLEET)
    list(APPEND options --fleet)
    list(APPEND made ${out}/${stem}.kb.fleet.h ${out}/${stem}.kb.fleet.cc)
    foreach(recording ${arg_PROFILE})
      get_filename_component(recording ${recording} ABSOLUTE)
      list(APPEND options --profile ${recording})
    endforeach()
  elseif(arg_PROFILE)
    message(FATAL_ERROR "kb_add_library: PROFILE is of a FLEET")
  endif()
  if(arg_MAP)
    list(APPEND options --map)
    list(APPEND made ${out}/${stem}.kb.map.h)
  endif()

  set(namespace ${stem})
  if(arg_NAMESPACE)
    set(namespace ${arg_NAMESPACE})
    list(APPEND options --namespace ${namespace})
  endif()

  add_custom_command(
    OUTPUT ${made}
    COMMAND Waymark::kbc compile ${source} -o ${out}/${stem}.kb --depfile ${out}/${stem}.d ${options}
    DEPENDS ${source} ${stamp} Waymark::kbc
    DEPFILE ${out}/${stem}.d
    COMMENT "Compiling the knowledge base ${file}"
    COMMAND_EXPAND_LISTS VERBATIM)
  add_library(${name} STATIC ${made})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${out}> $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}>)
  # Who links two of one namespace is told so by CMake, where their headers would be ambiguous. Libraries that keep theirs to
  # themselves may meet: see note [two minds of one name] in compiler/emit/names.cc. The
  # message names the property and the two targets, so the name of the property says the rest. It is a word, for projects that export
  # NAME: CMake writes it unquoted.
  string(MAKE_C_IDENTIFIER "${namespace}" unique)
  string(PREPEND unique "a_program_can_link_one_knowledge_base_of_a_namespace__give_the_other_kb_add_library_a_NAMESPACE__")
  set_target_properties(${name} PROPERTIES COMPATIBLE_INTERFACE_STRING "${unique}" "INTERFACE_${unique}" ${name})
  target_link_libraries(${name} PUBLIC Waymark::runtime)
  if(arg_MAP)
    target_link_libraries(${name} PUBLIC Waymark::controllers)
  endif()
  if(arg_FLEET)
    target_link_libraries(${name} PUBLIC Waymark::fleet)
    # The kernel reads itself several times: see fleet/widths.h.
    set_source_files_properties(${made} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()

# kb_add_image(NAME FILE.kb [LIBRARY folder] [OPTIONS option...])
#
# A target NAME that makes the image NAME.kb/FILE.kbt below the current build folder, which a running robot can take
# (docs/image.md). It is made again when FILE.kb or any file that it imports has changed. The property KB_IMAGE of the target is the
# image's path.
function(kb_add_image name file)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "LIBRARY" "OPTIONS")
  kb_read_arguments(kb_add_image)
  set(image ${out}/${stem}.kbt)
  add_custom_command(
    OUTPUT ${image}
    COMMAND Waymark::kbc compile ${source} --emit image -o ${out}/${stem} --depfile ${image}.d ${options}
    DEPENDS ${source} ${stamp} Waymark::kbc
    DEPFILE ${image}.d
    COMMENT "Compiling the image of ${file}"
    COMMAND_EXPAND_LISTS VERBATIM)
  add_custom_target(${name} ALL DEPENDS ${image})
  set_target_properties(${name} PROPERTIES KB_IMAGE ${image})
endfunction()

cmake_policy(POP)
