# Puts files into a program as text: a C++ source with one string literal a file.
#
# equipoise_embed(OUTPUT source.cpp ARCHIVE name FILES name=path ...): adds the rule; run as a script (cmake -P) it does
# the writing. The files are those of equipoise::embedded::<archive>.

function(equipoise_embed)
  cmake_parse_arguments(E "" "OUTPUT;ARCHIVE" "FILES" ${ARGN})
  set(paths "")
  foreach(entry IN LISTS E_FILES)
    string(REGEX REPLACE "^[^=]*=" "" path "${entry}")
    list(APPEND paths "${path}")
  endforeach()
  add_custom_command(OUTPUT ${E_OUTPUT}
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${E_OUTPUT}" "-DARCHIVE=${E_ARCHIVE}" "-DFILES=${E_FILES}" -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${paths} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    COMMENT "Embedding files" VERBATIM)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE AND OUTPUT)
  file(WRITE "${OUTPUT}.new" "// Files as text; written by cmake/embed.cmake.\n#include \"equipoise/core/base/embedded.hpp\"\n\n"
    "namespace equipoise::embedded {\nnamespace {\nconst File files[] = {\n")
  foreach(entry IN LISTS FILES)
    string(REGEX REPLACE "=.*" "" name "${entry}")
    string(REGEX REPLACE "^[^=]*=" "" path "${entry}")
    file(READ "${path}" text)
    file(APPEND "${OUTPUT}.new" "{\"${name}\", R\"~embedded~(")
    file(APPEND "${OUTPUT}.new" "${text}")
    file(APPEND "${OUTPUT}.new" ")~embedded~\"},\n")
  endforeach()
  file(APPEND "${OUTPUT}.new" "};\n}  // namespace\nextern const Archive ${ARCHIVE};\nconst Archive ${ARCHIVE}{files, sizeof(files) / sizeof(files[0])};\n"
    "}  // namespace equipoise::embedded\n")
  file(RENAME "${OUTPUT}.new" "${OUTPUT}")
endif()
