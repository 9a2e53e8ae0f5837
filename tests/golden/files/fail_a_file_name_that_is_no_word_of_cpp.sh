# RUN: printf 'levels think\n' > '%t/😀.kb' && cd %t && kbc compile -w 😀.kb
# RUN: printf 'levels think\n' > '%t/Größe.kb' && cd %t && kbc compile -w Größe.kb && grep -h "^namespace" Größe.kb.h
# RUN: printf 'levels think\n' > '%t/a.kb' && cd %t && kbc compile -w a.kb --namespace $'a\xff'
