# SPDX-License-Identifier: MIT
# Writes the bill of materials of the library, SPDX 2.3: the header, the sources and the licence with their hashes, and
# the packages that tests and tool use. The library itself depends on nothing.
# cmake -DSOURCE=FOLDER -DVERSION=0.3.0 -DOUT=topoadapt.spdx.json -P sbom.cmake

file(GLOB files RELATIVE ${SOURCE} ${SOURCE}/include/*.h ${SOURCE}/include/*.hpp ${SOURCE}/src/*/*.h ${SOURCE}/src/*/*.cpp ${SOURCE}/LICENSE)
list(SORT files)

# append_to LIST SEPARATED_BY_COMMAS
macro(append_to list item)
  string(APPEND ${list} "${separator_${list}}\n    ${item}")
  set(separator_${list} ",")
endmacro()

# package ID NAME VERSION LICENSE PURPOSE RELATIONSHIP
function(package id name version license purpose relationship)
  append_to(packages "{\"SPDXID\": \"SPDXRef-${id}\", \"name\": \"${name}\", \"versionInfo\": \"${version}\", \
\"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": false, \"licenseConcluded\": \"${license}\", \
\"licenseDeclared\": \"${license}\", \"copyrightText\": \"NOASSERTION\", \"comment\": \"${purpose}\"}")
  append_to(relationships "{\"spdxElementId\": \"SPDXRef-${id}\", \"relationshipType\": \"${relationship}\", \
\"relatedSpdxElement\": \"SPDXRef-topoadapt\"}")
  foreach(list packages relationships)
    set(${list} "${${list}}" PARENT_SCOPE)
    set(separator_${list} "," PARENT_SCOPE)
  endforeach()
endfunction()

set(hashes "")
foreach(file IN LISTS files)
  file(STRINGS ${SOURCE}/${file} license REGEX "SPDX-License-Identifier: MIT|^MIT License" LIMIT_COUNT 1)
  if(license STREQUAL "")
    message(FATAL_ERROR "${file} names no licence")
  endif()
  file(SHA1 ${SOURCE}/${file} sha1)
  file(SHA256 ${SOURCE}/${file} sha256)
  list(APPEND hashes ${sha1})
  string(REGEX REPLACE "[^A-Za-z0-9.]" "-" id "SPDXRef-file-${file}")
  append_to(entries "{\"SPDXID\": \"${id}\", \"fileName\": \"./${file}\", \"checksums\": [{\"algorithm\": \"SHA1\", \
\"checksumValue\": \"${sha1}\"}, {\"algorithm\": \"SHA256\", \"checksumValue\": \"${sha256}\"}], \
\"licenseConcluded\": \"MIT\", \"licenseInfoInFiles\": [\"MIT\"], \"copyrightText\": \"The topoadapt authors\"}")
  append_to(relationships "{\"spdxElementId\": \"SPDXRef-topoadapt\", \"relationshipType\": \"CONTAINS\", \
\"relatedSpdxElement\": \"${id}\"}")
endforeach()
# The code of SPDX 2.3, section 7.9: the hash of the sorted hashes.
list(SORT hashes)
list(JOIN hashes "" hashes)
string(SHA1 code "${hashes}")

append_to(packages "{\"SPDXID\": \"SPDXRef-topoadapt\", \"name\": \"topoadapt\", \"versionInfo\": \"${VERSION}\", \
\"supplier\": \"Organization: The topoadapt authors\", \"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": true, \
\"packageVerificationCode\": {\"packageVerificationCodeValue\": \"${code}\"}, \"primaryPackagePurpose\": \"LIBRARY\", \
\"licenseConcluded\": \"MIT\", \"licenseDeclared\": \"MIT\", \"licenseInfoFromFiles\": [\"MIT\"], \
\"copyrightText\": \"Copyright (c) The topoadapt authors\", \
\"comment\": \"No run-time dependency: the library calls memcpy, memmove, memset and memcmp.\"}")
package(googletest GoogleTest 1.14.0 BSD-3-Clause "Tests only" TEST_DEPENDENCY_OF)
package(zlib zlib NOASSERTION Zlib "Tool only, optional: compressed volumes" OPTIONAL_DEPENDENCY_OF)
package(niftilib niftilib NOASSERTION LicenseRef-public-domain "Tool only, optional: NIfTI volumes" OPTIONAL_DEPENDENCY_OF)

string(TIMESTAMP now "%Y-%m-%dT%H:%M:%SZ" UTC)  # of SOURCE_DATE_EPOCH, if set
file(WRITE ${OUT} "{
  \"spdxVersion\": \"SPDX-2.3\",
  \"dataLicense\": \"CC0-1.0\",
  \"SPDXID\": \"SPDXRef-DOCUMENT\",
  \"name\": \"topoadapt-${VERSION}\",
  \"documentNamespace\": \"https://spdx.org/spdxdocs/topoadapt-${VERSION}-${code}\",
  \"creationInfo\": {\"created\": \"${now}\", \"creators\": [\"Organization: The topoadapt authors\", \"Tool: cmake/sbom.cmake\"]},
  \"documentDescribes\": [\"SPDXRef-topoadapt\"],
  \"hasExtractedLicensingInfos\": [{\"licenseId\": \"LicenseRef-public-domain\", \"extractedText\": \"niftilib is in the public domain.\"}],
  \"packages\": [${packages}
  ],
  \"files\": [${entries}
  ],
  \"relationships\": [${relationships}
  ]
}
")
