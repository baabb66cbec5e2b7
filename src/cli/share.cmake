# Run by the build: FUSEE writes its manual pages and completions below SHARED.
function(write file)
  get_filename_component(folder ${SHARED}/${file} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  execute_process(COMMAND ${FUSEE} ${ARGN} OUTPUT_FILE ${SHARED}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Pages are compressed, as Debian requires, without a time stamp: equal programs give equal bytes.
function(write_page page)
  write(man/man1/${page} manual ${ARGN})
  execute_process(COMMAND gzip -9nf ${SHARED}/man/man1/${page} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

write_page(fusee.1)
foreach(command IN LISTS COMMANDS)
  write_page(fusee-${command}.1 ${command})
endforeach()
write(bash-completion/completions/fusee completion bash)
write(zsh/site-functions/_fusee completion zsh)
write(fish/vendor_completions.d/fusee.fish completion fish)
