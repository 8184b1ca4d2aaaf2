"""``python -m shapeviz_report``: the command line."""

import sys

from shapeviz_report.cli import main

if __name__ == "__main__":
    sys.exit(main())
