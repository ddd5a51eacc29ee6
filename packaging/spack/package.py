# Not run: checked as Python alone; the names of Spack's packages were not looked up. It has no url or git line, for no public address is known; until there is one:
#
#     spack repo add FOLDER_WITH packages/equipoise/package.py
#     spack dev-build --source-path /folder/of/equipoise equipoise@0.3.0
from spack.package import *


class Equipoise(CMakePackage):
    """Will a ball balancer work on this rotor? How reliably, how fast, and how hard will the machine vibrate on the way up to speed?"""

    license("MIT")

    version("0.3.0")

    variant("mpi", default=False, description="Sweeps, capacities and designs as MPI jobs")
    variant("pagmo", default=True, description="CMA-ES and NSGA-II for designs")
    variant("shared", default=True, description="One shared library in place of static ones")

    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("python@3.9:", type="build")
    depends_on("boost")
    depends_on("cli11@2.1:")
    depends_on("eigen@3.4:")
    depends_on("fmt@9:")
    depends_on("highway@1.0.3:")
    depends_on("intel-oneapi-tbb")
    depends_on("netcdf-c")
    depends_on("libpng@1.6:")
    depends_on("nlohmann-json@3.11:")
    depends_on("random123")
    depends_on("tomlplusplus@3.3:")
    depends_on("mpi", when="+mpi")
    depends_on("pagmo2", when="+pagmo")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("EQUIPOISE_KERNELS", "all"),
            self.define_from_variant("EQUIPOISE_SHARED", "shared"),
            self.define_from_variant("EQUIPOISE_MPI", "mpi"),
            self.define_from_variant("EQUIPOISE_WITH_PAGMO", "pagmo"),
        ]

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def check_install(self):
        program = Executable(self.prefix.bin.equipoise)
        study = join_path(self.prefix.share, "equipoise", "studies", "paper", "table-2-omega-2.4.toml")
        program("basin", study, "--starts", "1000", "--quiet")
