# SPDX-License-Identifier: MIT
"""What pip calls at the repository's root: setuptools, in the folder of this file."""
import os

os.chdir(os.path.dirname(os.path.abspath(__file__)))

from setuptools.build_meta import *  # noqa: E402,F401,F403
