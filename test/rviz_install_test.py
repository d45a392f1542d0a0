#!/usr/bin/env python3
"""What `cmake --install` leaves is enough for node and rviz: neither sees the build folder."""
import os
import pathlib
import subprocess
import tempfile

from rviz_window import ERROR, PATIENCE, SHIPPED, RvizTest, run, start

LISTS = ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", "LD_LIBRARY_PATH", "PYTHONPATH", "PKG_CONFIG_PATH")


def build_folder():
    """The one that the test was built in; None if it has a devel space elsewhere, as in a workspace."""
    for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(":"):
        if pathlib.Path(prefix).parent.joinpath("cmake_install.cmake").exists():
            return pathlib.Path(prefix).parent
    return None


def install(build, folder):
    """Installs a build folder below another and returns the prefix there. As packagers do: the build
    folder's own prefix stays what it is, so that nothing is configured anew."""
    subprocess.run(["cmake", "--install", build, "--component", "Unspecified"], check=True,
                   stdout=subprocess.DEVNULL, env=dict(os.environ, DESTDIR=folder))
    package, = pathlib.Path(folder).glob("**/share/cloth_tearing/package.xml")
    return package.parents[2]


def environment_of(prefix, build):
    """The environment of the test with the prefix in the place of the build folder."""
    environment = dict(os.environ)
    for name in LISTS:
        entries = [e for e in environment.get(name, "").split(":") if e and not belongs(e, build)]
        environment[name] = ":".join(entries)
    ours = {"CMAKE_PREFIX_PATH": prefix, "ROS_PACKAGE_PATH": prefix / "share",
            "LD_LIBRARY_PATH": prefix / "lib"}
    for name, path in ours.items():
        environment[name] = f"{path}:{environment[name]}".rstrip(":")
    return environment


def belongs(path, build):
    """Whether it is in the build folder, or a folder of sources with our package in it."""
    path = pathlib.Path(path)
    return (path.is_relative_to(build) or (path / "package.xml").exists() or
            (path / "lib/libcloth_tearing_rviz.so").exists())


class RvizInstall(RvizTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        build = build_folder()
        cls.prefix = install(build, folder.name)
        environment = environment_of(cls.prefix, build)
        cls.node = start([cls.prefix / "lib/cloth_tearing/cloth_tearing_node", "__name:=cloth",
                          "_paused:=true"], env=environment)
        cls.addClassCleanup(cls.end_node)
        cls.open(cls.prefix / "share/cloth_tearing/config/cloth.rviz", environment)

    @classmethod
    def end_node(cls):
        cls.node.kill()
        cls.node.wait(PATIENCE)

    def test_shows_the_textured_cloth_of_an_installed_node(self):
        picture = self.wait_for("the shipped image",
                                lambda p: p.shows(SHIPPED.values(), self.scene, least=4000))

        self.keep("cloth")
        self.assertFalse(picture.has_sign(ERROR), "a status is red")

    def test_uses_nothing_but_what_was_installed(self):
        loaded = pathlib.Path(f"/proc/{self.rviz.pid}/maps").read_text()
        ours = {line.split(maxsplit=5)[-1] for line in loaded.splitlines() if "libcloth_tearing" in line}

        self.assertEqual(ours, {str(self.prefix / "lib" / name) for name in
                                ("libcloth_tearing_rviz.so", "libcloth_tearing_core.so")})


if __name__ == "__main__":
    run("rviz_install", RvizInstall, [] if build_folder() else ["a build folder to install from"])
