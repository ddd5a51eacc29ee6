# Wright and Peng (2019): what they printed, and everything of it computed again; and what both libraries carry inside.
add_library(equipoise_paper STATIC
  extras/literature/judgement.cpp extras/literature/published_tables.cpp
  extras/reproduction/open_questions.cpp extras/reproduction/paper_figures.cpp extras/reproduction/reproduce.cpp
    extras/reproduction/reproduction.cpp extras/reproduction/reproduction_document.cpp
    extras/reproduction/table_7.cpp
)

# What the libraries carry inside themselves: how pages look; studies to begin with; the published tables and the studies of their rows.
include(${PROJECT_SOURCE_DIR}/cmake/embed.cmake)
set(page_files "")
foreach(name document.css sheet.css)
  list(APPEND page_files ${name}=${CMAKE_CURRENT_SOURCE_DIR}/report/drawing/${name})
endforeach()
equipoise_embed(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/page_files.cpp ARCHIVE page_files FILES ${page_files})
target_sources(equipoise PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/page_files.cpp)
# Studies to begin with, in the order of the command's list.
set(new_studies "")
foreach(name washing-machine grinder centrifuge drive fan blank)
  list(APPEND new_studies ${name}=${PROJECT_SOURCE_DIR}/studies/new/${name}.toml)
endforeach()
equipoise_embed(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/new_studies.cpp ARCHIVE new_studies FILES ${new_studies})
target_sources(equipoise PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/new_studies.cpp)
set(paper_files "")
file(GLOB published CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/studies/paper/published/*.csv)
file(GLOB studies CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/studies/paper/*.toml)
foreach(path IN LISTS published)
  get_filename_component(name ${path} NAME)
  list(APPEND paper_files published/${name}=${path})
endforeach()
foreach(path IN LISTS studies)
  get_filename_component(name ${path} NAME)
  list(APPEND paper_files studies/${name}=${path})
endforeach()
list(APPEND paper_files conclusions.csv=${PROJECT_SOURCE_DIR}/studies/paper/conclusions.csv
  evidence/table-7-candidates.csv=${PROJECT_SOURCE_DIR}/docs/evidence/table-7-candidates.csv)
equipoise_embed(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/paper_files.cpp ARCHIVE paper_files FILES ${paper_files})
target_sources(equipoise_paper PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/paper_files.cpp)

target_link_libraries(equipoise_paper PUBLIC equipoise PRIVATE
  TBB::tbb fmt::fmt $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
target_compile_options(equipoise_paper PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor ${equipoise_cold_options})
set_target_properties(equipoise_paper PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 9)
equipoise_precompile(equipoise_paper <Eigen/Core> <fmt/format.h>)
