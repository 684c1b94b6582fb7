# SPDX-License-Identifier: Apache-2.0
# embed_kernels runs this. It writes the kernels below `folder` into the C++ source `output`.
file(GLOB_RECURSE files RELATIVE ${folder} ${folder}/*.cl ${folder}/*.h)
list(SORT files)
set(text "#include \"runtime/opencl/source/kernel_source.hpp\"\n\nnamespace voxelume {\n\n")
string(APPEND text "const std::map<std::string, std::string_view>& embedded_kernels() {\n")
string(APPEND text "    static const std::map<std::string, std::string_view> files = {\n")
foreach(file IN LISTS files)
    file(READ ${folder}/${file} content HEX)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" content "${content}")
    string(APPEND text "        {\"${file}\", std::string_view(\"${content}\")},\n")
endforeach()
string(APPEND text "    };\n    return files;\n}\n\n}  // namespace voxelume\n")
file(WRITE ${output} "${text}")
