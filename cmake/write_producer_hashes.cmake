# SPDX-License-Identifier: Apache-2.0
# hash_producers runs this. It writes hashes of `files` into the C++ source `output`.
set(text "#include \"runtime/base/files/producer_hash.hpp\"\n\nnamespace voxelume {\n\n")
string(APPEND text "const char* producer_hash() {\n    return\n")
foreach(file IN LISTS files)
    file(MD5 ${file} hash)
    string(APPEND text "        \"${hash}\"\n")
endforeach()
string(APPEND text "        \"\";\n}\n\n}  // namespace voxelume\n")
file(WRITE ${output} "${text}")
