"""The design study with joblib, on one machine; it continues after an interruption too.

pip install './python[cluster]' joblib
python design_study_joblib.py results
"""

import sys
from pathlib import Path

from design_study import Study, optimum, read_all, table, unfinished_blocks, write_block
from joblib import Parallel, delayed


def run(study: Study, folder: Path, jobs: int = -1) -> None:
    left = unfinished_blocks(study, folder)
    Parallel(n_jobs=jobs)(delayed(write_block)(study, folder, block) for block in left)


if __name__ == "__main__":
    study, folder = Study(), Path(sys.argv[1])
    run(study, folder)
    print(table(optimum(study, read_all(study, folder))))
