# SPDX-License-Identifier: Apache-2.0
# embed_scene runs this. It writes the text of `file` into the C++ source `output`, as the function
# `name`.
file(READ ${file} content HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" content "${content}")
file(WRITE ${output} "#include <string_view>\n\nnamespace voxelume {\n\nstd::string_view ${name}();\n"
     "std::string_view ${name}() {\n    return \"${content}\";\n}\n\n}  // namespace voxelume\n")
