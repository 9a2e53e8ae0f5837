# What the tests of planners share, for the fuzz targets and benches as well.
set(helpers meetings.cc patrols.cc planning.cc separate_obstacles.cc)
list(TRANSFORM helpers PREPEND ${CMAKE_CURRENT_LIST_DIR}/ OUTPUT_VARIABLE helper_files)
add_library(kb_planner_testing STATIC ${helper_files})
target_include_directories(kb_planner_testing PUBLIC ${PROJECT_SOURCE_DIR})
target_compile_definitions(kb_planner_testing PRIVATE KB_PROJECT_ROOT="${PROJECT_SOURCE_DIR}")
target_link_libraries(kb_planner_testing PUBLIC kb_planners kb_planner_maps PRIVATE waymark_warnings)
