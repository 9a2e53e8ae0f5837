# RUN: mkdir %t/rooms; echo 'fact Door' > %t/rooms/door.kb; printf 'import "rooms\\door.kb"\n' > %t/house.kb; cd %t; kbc check house.kb
