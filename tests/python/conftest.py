# SPDX-License-Identifier: MIT
from hypothesis import settings

# Time limits for a single example are no test on machines that do other work; what is found is not kept.
settings.register_profile("boxstream", deadline=None, database=None, print_blob=True)
settings.load_profile("boxstream")
