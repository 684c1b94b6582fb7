# SPDX-License-Identifier: Apache-2.0
# packages.txt -> voxelume.spdx.json: what the program and the library are built from, with the
# versions that are installed, as SPDX 2.3. Tests' packages aren't listed.

# write_sbom(OUTPUT): needs dpkg-query; without it the file lists the project alone.
function(write_sbom output)
    file(STRINGS ${CMAKE_SOURCE_DIR}/packages.txt lines)
    set(names g++)
    foreach(line IN LISTS lines)
        if(line MATCHES "^# Tests")
            break()
        elseif(line MATCHES "^([a-z][^ ]*-dev|opencl-[^ ]*)")
            list(APPEND names ${CMAKE_MATCH_1})
        endif()
    endforeach()
    execute_process(COMMAND dpkg-query -W -f "\${Package} \${Version} \${Architecture}\n" ${names}
                    OUTPUT_VARIABLE found ERROR_QUIET)
    string(TIMESTAMP created "%Y-%m-%dT%H:%M:%SZ" UTC)
    set(packages "{
      \"SPDXID\": \"SPDXRef-voxelume\", \"name\": \"voxelume\", \"versionInfo\": \"${PROJECT_VERSION}\",
      \"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": false, \"licenseConcluded\": \"Apache-2.0\",
      \"licenseDeclared\": \"Apache-2.0\", \"copyrightText\": \"NOASSERTION\"}")
    set(relations "{\"spdxElementId\": \"SPDXRef-DOCUMENT\", \"relationshipType\": \"DESCRIBES\",
      \"relatedSpdxElement\": \"SPDXRef-voxelume\"}")
    string(REPLACE "\n" ";" found "${found}")
    foreach(line IN LISTS found)
        if(NOT line MATCHES "^([^ ]+) ([^ ]+) ([^ ]+)$")
            continue()
        endif()
        set(name ${CMAKE_MATCH_1})
        set(version ${CMAKE_MATCH_2})
        set(architecture ${CMAKE_MATCH_3})
        string(REGEX REPLACE "[^A-Za-z0-9.-]" "-" id ${name})
        string(REPLACE "+" "%2B" quoted_name ${name})
        string(REPLACE "+" "%2B" quoted_version ${version})
        string(APPEND packages ", {
      \"SPDXID\": \"SPDXRef-${id}\", \"name\": \"${name}\", \"versionInfo\": \"${version}\",
      \"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": false, \"licenseConcluded\": \"NOASSERTION\",
      \"licenseDeclared\": \"NOASSERTION\", \"copyrightText\": \"NOASSERTION\",
      \"externalRefs\": [{\"referenceCategory\": \"PACKAGE-MANAGER\", \"referenceType\": \"purl\",
        \"referenceLocator\": \"pkg:deb/debian/${quoted_name}@${quoted_version}?arch=${architecture}\"}]}")
        string(APPEND relations ",
    {\"spdxElementId\": \"SPDXRef-${id}\", \"relationshipType\": \"BUILD_DEPENDENCY_OF\",
      \"relatedSpdxElement\": \"SPDXRef-voxelume\"}")
    endforeach()
    string(SHA256 identity "${packages}")
    file(WRITE ${output} "{
  \"spdxVersion\": \"SPDX-2.3\", \"dataLicense\": \"CC0-1.0\", \"SPDXID\": \"SPDXRef-DOCUMENT\",
  \"name\": \"voxelume-${PROJECT_VERSION}\",
  \"documentNamespace\": \"https://spdx.org/spdxdocs/voxelume-${PROJECT_VERSION}-${identity}\",
  \"creationInfo\": {\"created\": \"${created}\", \"creators\": [\"Tool: voxelume-cmake\"]},
  \"packages\": [${packages}],
  \"relationships\": [${relations}]
}
")
endfunction()

write_sbom(${CMAKE_BINARY_DIR}/voxelume.spdx.json)
install(FILES ${CMAKE_BINARY_DIR}/voxelume.spdx.json DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/voxelume)
