# RUN: mkdir -p %t/new; touch %t/file; cd %t/new; kbc new .; cd ..; kbc new file
