# SPDX-License-Identifier: Apache-2.0
# embed_page runs this. It writes the files `page` and `script` into the C++ source `output`.
set(text "#include \"runtime/io/volume/volume_page.hpp\"\n\nnamespace voxelume {\n\n")
function(add_part name file)
    file(READ ${file} content HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" content "${content}")
    set(text "${text}std::string_view ${name}() {\n    return \"${content}\";\n}\n\n" PARENT_SCOPE)
endfunction()
add_part(page_text ${page})
add_part(page_script ${script})
file(WRITE ${output} "${text}}  // namespace voxelume\n")
