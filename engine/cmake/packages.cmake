# Every outside package, found once. Each is hidden by the one folder named beside it.
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)                 # engine/base
find_package(embree 3.13 REQUIRED)         # engine/accel
find_package(Imath REQUIRED)
find_package(OpenEXR REQUIRED)             # engine/pictures
find_package(PNG REQUIRED)                 # engine/pictures
find_package(JPEG REQUIRED)                # engine/pictures
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(pugixml REQUIRED)            # materials/measured
find_package(tomlplusplus REQUIRED)        # engine/base
find_package(CLI11 REQUIRED)               # plugins/cli
find_package(OpenMesh REQUIRED)            # engine/geometry
find_package(draco REQUIRED)               # importers/gltf
find_package(meshoptimizer REQUIRED)       # importers/gltf
find_package(assimp 5.2 REQUIRED)          # importers/assimp, the child program alone
find_package(TinyGLTF REQUIRED)            # importers/gltf
find_package(Python3 REQUIRED COMPONENTS Interpreter) # tests/structure, tests/cli

# Debian's configuration of OpenSubdiv names static libraries that the package does not have.
find_path(OPENSUBDIV_INCLUDE_DIR opensubdiv/far/topologyRefiner.h REQUIRED)
find_library(OPENSUBDIV_CPU_LIBRARY osdCPU REQUIRED)
add_library(OpenSubdiv::osdCPU UNKNOWN IMPORTED) # engine/geometry
set_target_properties(OpenSubdiv::osdCPU PROPERTIES IMPORTED_LOCATION ${OPENSUBDIV_CPU_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${OPENSUBDIV_INCLUDE_DIR})
