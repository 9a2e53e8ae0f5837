# Configures and builds the preset cortex-m3 in BUILD, with the kbc of this build.
file(REMOVE_RECURSE ${BUILD})
set(ENV{CXXFLAGS} -fcallgraph-info=su)   # for stack_bound.py
# A compiler cache hands back the object without the call graph that was written beside it.
unset(ENV{CMAKE_CXX_COMPILER_LAUNCHER})
foreach(command
    "--preset;cortex-m3;-S;${SOURCE};-B;${BUILD};-DWAYMARK_KBC=${KBC};-DWAYMARK_WERROR=ON"
    "--build;${BUILD}")
  execute_process(COMMAND ${CMAKE_COMMAND} ${command} WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: cmake ${command}")
  endif()
endforeach()
