# Run by hash_makers: writes hashes of `files` into the C++ source `output`.
set(text "#include \"runtime/base/maker_sources.hpp\"\n\nnamespace voxelume {\n\n")
string(APPEND text "const char* maker_sources() {\n    return\n")
foreach(file IN LISTS files)
    file(MD5 ${file} hash)
    string(APPEND text "        \"${hash}\"\n")
endforeach()
string(APPEND text "        \"\";\n}\n\n}  // namespace voxelume\n")
file(WRITE ${output} "${text}")
