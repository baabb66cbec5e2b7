# Run by the build: FUSEE writes its manual pages and completions below SHARED.
function(write file)
  get_filename_component(folder ${SHARED}/${file} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  execute_process(COMMAND ${FUSEE} ${ARGN} OUTPUT_FILE ${SHARED}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

write(man/man1/fusee.1 manual)
foreach(command IN LISTS COMMANDS)
  write(man/man1/fusee-${command}.1 manual ${command})
endforeach()
write(bash-completion/completions/fusee completion bash)
write(zsh/site-functions/_fusee completion zsh)
write(fish/vendor_completions.d/fusee.fish completion fish)
