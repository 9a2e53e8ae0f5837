# RUN: printf '{"t":1,"compass_rad":6.4}\n{"t":1.02,"compass_rad":6.5}\n{"t":1.04,"compass_rad":90}\n' | kbc drive session.d/compass.kb | cut -c 1-30
