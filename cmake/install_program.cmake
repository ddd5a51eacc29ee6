# The program, and what belongs to it: manual pages and completions, which are made of its own help as it is installed;
# and studies.
install(TARGETS equipoise_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)

find_package(Python3 3.9 COMPONENTS Interpreter)
if(Python3_Interpreter_FOUND AND NOT CMAKE_CROSSCOMPILING)
  set(zsh_folder site-functions)
  if(EQUIPOISE_DEBIAN)
    set(zsh_folder vendor-completions)
  endif()
  set(help_dir ${PROJECT_BINARY_DIR}/help)
  install(CODE "execute_process(COMMAND \"${Python3_EXECUTABLE}\" -B \"${PROJECT_SOURCE_DIR}/packaging/help_files.py\"
    \"$<TARGET_FILE:equipoise_program>\" \"${help_dir}\"
    \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/equipoise/studies\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT program)
  install(DIRECTORY ${help_dir}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
  install(FILES ${help_dir}/equipoise.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    RENAME equipoise COMPONENT program)
  install(FILES ${help_dir}/_equipoise DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${zsh_folder} COMPONENT program)
  install(FILES ${help_dir}/equipoise.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
else()
  message(STATUS "Manual pages and completions are not installed: they want Python, and a program that runs here")
endif()

# Studies are data, not documentation: smaller systems leave out /usr/share/doc.
install(DIRECTORY studies/ DESTINATION ${CMAKE_INSTALL_DATADIR}/equipoise/studies COMPONENT program
  FILES_MATCHING PATTERN "*.toml")
