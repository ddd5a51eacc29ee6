# The fuzz target, with libFuzzer where asked for and with a driver of our own everywhere else. Both run a bounded,
# seeded number of inputs as a test; for a longer search run the program by hand.
add_executable(study_fuzz fuzz/study_fuzz.cpp)
add_dependencies(equipoise_tests study_fuzz)
target_compile_options(study_fuzz PRIVATE -Wall -Wextra)
set(seeds ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/seeds ${PROJECT_SOURCE_DIR}/studies)
set(dictionary ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/study.dict)
if(EQUIPOISE_BUILD_FUZZER)
  # The reader, and with it toml++ and fmt as headers, is compiled into the target with coverage: so the search sees
  # into all three, and nothing else of the library has to be instrumented.
  set(library ${PROJECT_SOURCE_DIR}/src/equipoise)
  file(GLOB reader CONFIGURE_DEPENDS ${library}/study/contents/*.cpp ${library}/study/reading/*.cpp)
  target_sources(study_fuzz PRIVATE ${reader} ${library}/core/base/display_text.cpp ${library}/core/base/error.cpp ${library}/core/base/read_number.cpp
    ${library}/machine/drives/speed.cpp ${library}/core/statistics/distributions.cpp)
  target_include_directories(study_fuzz PRIVATE ${PROJECT_SOURCE_DIR}/src
    $<TARGET_PROPERTY:tomlplusplus::tomlplusplus,INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(study_fuzz PRIVATE fmt::fmt-header-only)
  target_compile_options(study_fuzz PRIVATE -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined)
  target_link_options(study_fuzz PRIVATE -fsanitize=fuzzer,address,undefined)
  set(corpus ${CMAKE_CURRENT_BINARY_DIR}/study_corpus)  # new inputs go here; the seeds are only read
  file(MAKE_DIRECTORY ${corpus})
  add_test(NAME study_fuzz
    COMMAND study_fuzz -runs=20000 -seed=1 -max_len=4096 -dict=${dictionary} ${corpus} ${seeds})
else()
  target_sources(study_fuzz PRIVATE fuzz/fuzz_driver.cpp)
  target_link_libraries(study_fuzz PRIVATE equipoise)
  add_test(NAME study_fuzz COMMAND study_fuzz --inputs 20000 --seed 1 --dictionary ${dictionary} ${seeds})
endif()
set_tests_properties(study_fuzz PROPERTIES LABELS fuzz TIMEOUT ${longest_test})

# Files of results, changed behind their checksums. The driver is its own: it knows how each kind is built.
if(NOT EQUIPOISE_BUILD_FUZZER)
  add_executable(file_fuzz fuzz/file_fuzz.cpp fuzz/file_changes.cpp)
  add_dependencies(equipoise_tests file_fuzz)
  target_compile_options(file_fuzz PRIVATE -Wall -Wextra)
  target_link_libraries(file_fuzz PRIVATE equipoise nlohmann_json::nlohmann_json fmt::fmt Eigen3::Eigen)
  add_test(NAME file_fuzz COMMAND file_fuzz 5000 1)
  set_tests_properties(file_fuzz PROPERTIES LABELS fuzz TIMEOUT ${longest_test})
endif()
