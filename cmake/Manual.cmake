# SPDX-License-Identifier: Apache-2.0
# The manual page and the completions of shells, which the program itself prints.
set(manual ${CMAKE_BINARY_DIR}/manual)
add_custom_command(
    OUTPUT ${manual}/voxelume.1.gz ${manual}/voxelume ${manual}/_voxelume ${manual}/voxelume.fish
    COMMAND ${CMAKE_COMMAND} -E make_directory ${manual}
    COMMAND $<TARGET_FILE:voxelume> man > ${manual}/voxelume.1
    COMMAND gzip -9nf ${manual}/voxelume.1
    COMMAND $<TARGET_FILE:voxelume> completion bash > ${manual}/voxelume
    COMMAND $<TARGET_FILE:voxelume> completion zsh > ${manual}/_voxelume
    COMMAND $<TARGET_FILE:voxelume> completion fish > ${manual}/voxelume.fish
    DEPENDS voxelume
    COMMENT "Printing the manual page and completions"
    VERBATIM)
add_custom_target(voxelume_manual ALL DEPENDS ${manual}/voxelume.1.gz)
install(FILES ${manual}/voxelume.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${manual}/voxelume DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${manual}/_voxelume DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${manual}/voxelume.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
