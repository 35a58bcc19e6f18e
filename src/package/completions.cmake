# What completes command lines in shells, where these look for it.

if(NOT CMAKE_CROSSCOMPILING)
  install(FILES "${completion_dir}/${CBC_PROGRAM_NAME}"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
  install(FILES "${completion_dir}/_${CBC_PROGRAM_NAME}"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
  install(FILES "${completion_dir}/${CBC_PROGRAM_NAME}.fish"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
endif()
