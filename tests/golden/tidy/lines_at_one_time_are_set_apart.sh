# RUN: printf '{"t":5}\n{"t":1}\n' > %t/drive.jsonl; kbc tidy %t/drive.jsonl --clock shift
