# SPDX-License-Identifier: MIT
import pytest
from hypothesis import settings

# Time limits for a single example are no test on machines that do other work. Examples are the same in each run, so that
# no change fails by chance; what is found is not kept.
settings.register_profile("boxstream", deadline=None, database=None, derandomize=True, print_blob=True)
settings.load_profile("boxstream")


def pytest_collection_modifyitems(items):
    """Many boxes are invalid on purpose; a test of the warning asks for it by pytest.warns."""
    for item in items:
        item.add_marker(pytest.mark.filterwarnings("ignore::boxstream.InvalidBoxesWarning"))
