# Homebrew. NOT TESTED: no machine of the project has Homebrew. A release's address and hash are missing.
class Fusee < Formula
  desc "From a tendon-driven joint to the exact pulley that drives it"
  homepage "https://example.org/fusee"
  url "https://example.org/fusee-0.2.0.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000"
  license "GPL-3.0-or-later"

  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "ninja" => :build
  depends_on "pkgconf" => :build
  depends_on "nlohmann-json" => :build
  depends_on "boost"
  depends_on "cgal"
  depends_on "draco"
  depends_on "eigen"
  depends_on "fmt"
  depends_on "libzip"
  depends_on "lz4"
  depends_on "open-mesh"
  depends_on "opencascade"
  depends_on "openssl@3"
  depends_on "pagmo"
  depends_on "pugixml"
  depends_on "sqlite"
  depends_on "tomlplusplus"
  depends_on "zstd"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DFUSEE_TESTS=OFF", "-DFUSEE_PYTHON=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    system bin/"fusee", "new", "forearm", "-o", "arm.toml"
    system bin/"fusee", "build", "arm.toml"
    assert_path_exists testpath/"out/arm/pulley.3mf"
  end
end
