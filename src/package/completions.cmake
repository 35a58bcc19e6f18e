# What completes command lines in shells, where these look for it. The scripts complete `cbc`.

if(NOT CMAKE_CROSSCOMPILING AND CBC_PROGRAM_NAME STREQUAL "cbc")
  install(FILES "${completion_dir}/cbc" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
  install(FILES "${completion_dir}/_cbc" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
  install(FILES "${completion_dir}/cbc.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
endif()
